/** Requests to the service. Every refusal becomes a `Refused`, with the problem detail that the service sent. */

import { foundNobody } from "./connection";
import type { components } from "./openapi";

export type Problem = components["schemas"]["Problem"];

/** The service refused, or could not be reached (status 0). */
export class Refused extends Error {
  constructor(readonly problem: Problem) {
    super(problem.detail);
  }

  get status(): number {
    return this.problem.status;
  }
}

/** A body and the tag by which the next write names what was read. */
export interface Tagged<T> {
  readonly body: T;
  readonly tag: string;
}

type Listener = () => void;

const signedOut = new Set<Listener>();

/** Tells when the service needs a key and got none, or one that opens nothing. */
export function onSignedOut(listener: Listener): void {
  signedOut.add(listener);
}

interface Wish {
  readonly method?: string;
  readonly json?: unknown;
  readonly body?: BodyInit;
  readonly headers?: Record<string, string>;
  readonly signal?: AbortSignal;
}

/** Asks the service; the path is relative to the page. */
export async function ask(path: string, wish: Wish = {}): Promise<Response> {
  const headers = new Headers({ Accept: "application/json", ...wish.headers });
  if (wish.json !== undefined && !headers.has("Content-Type")) headers.set("Content-Type", "application/json");
  const body = wish.json === undefined ? wish.body : JSON.stringify(wish.json);
  const request: RequestInit = { method: wish.method ?? "GET", headers };
  if (body !== undefined) request.body = body;
  if (wish.signal) request.signal = wish.signal;
  let response: Response;
  try {
    response = await fetch(path, request);
  } catch (error) {
    if (error instanceof DOMException && error.name === "AbortError") throw error;
    foundNobody();
    throw new Refused({ type: "about:blank", title: "", status: 0, detail: "", instance: path });
  }
  if (response.status === 401) for (const listener of signedOut) listener();
  if (!response.ok) throw new Refused(await problemOf(response, path));
  return response;
}

async function problemOf(response: Response, path: string): Promise<Problem> {
  const text = await response.text();
  try {
    const problem = JSON.parse(text) as Partial<Problem>;
    if (typeof problem.detail === "string" && typeof problem.title === "string") return problem as Problem;
  } catch {
    // What stands between the browser and the service answered in its own words.
  }
  return {
    type: "about:blank",
    title: response.statusText,
    status: response.status,
    detail: text.slice(0, 300),
    instance: path,
  };
}

/** The JSON that a path answers. */
export async function get<T>(path: string, signal?: AbortSignal): Promise<T> {
  return (await (await ask(path, signal ? { signal } : {})).json()) as T;
}

/** The same with its tag. */
export async function getTagged<T>(path: string): Promise<Tagged<T>> {
  return tagged(await ask(path));
}

/** Sends a change and reads what is in force afterwards. */
export async function send<T>(method: string, path: string, json: unknown, tag?: string): Promise<Tagged<T>> {
  const headers: Record<string, string> = tag === undefined ? {} : { "If-Match": tag };
  return tagged(await ask(path, json === undefined ? { method, headers } : { method, json, headers }));
}

async function tagged<T>(response: Response): Promise<Tagged<T>> {
  return { body: (await response.json()) as T, tag: response.headers.get("ETag") ?? "" };
}
