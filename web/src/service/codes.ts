/** Codes of a site's places: which wait for a person to confirm them. */

import { get, send } from "./request";
import type { Registry } from "./types";

export function readRegistry(map: string): Promise<Registry> {
  return get(`v1/maps/${map}/registry`);
}

/** Says that stale places are where the map shows them: those with the codes, or all. */
export async function confirmCodes(map: string, codes?: readonly string[]): Promise<void> {
  await send("POST", `v1/maps/${map}/registry/confirm`, codes ? { codes } : {});
}
