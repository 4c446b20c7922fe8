/** Whether somebody is signed in, where the service needs keys. The browser keeps the session; no script can read it. */

import { readStored, writeStored } from "../stored";
import { ask } from "./request";

/** Remembers that there is a session to end. */
const KEY = "stillage.signedIn";

/** Signs in with a key. */
export async function signIn(key: string): Promise<void> {
  await ask("v1/session", { method: "POST", headers: { Authorization: `Bearer ${key}` } });
  writeStored(KEY, true);
}

/** Ends the session. */
export async function signOut(): Promise<void> {
  await ask("v1/session", { method: "DELETE" });
  writeStored(KEY, undefined);
}

/** Whether somebody signed in with this browser. */
export function isSignedIn(): boolean {
  return readStored<boolean>(KEY) === true;
}
