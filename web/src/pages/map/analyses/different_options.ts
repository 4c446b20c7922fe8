/** The options in which two analyses differ. */

import { written } from "../../../service/options";

export interface DifferentOption {
  /** Its steps from the top, as docs/options.md writes them. */
  readonly path: string;
  readonly before: string;
  readonly now: string;
}

export function differentOptions(before: unknown, now: unknown, path = ""): DifferentOption[] {
  if (isObject(before) && isObject(now)) {
    const names = new Set([...Object.keys(before), ...Object.keys(now)]);
    return [...names].flatMap((name) => differentOptions(before[name], now[name], path ? `${path}/${name}` : name));
  }
  const [old, present] = [text(before), text(now)];
  return old === present ? [] : [{ path, before: old, now: present }];
}

function isObject(value: unknown): value is Record<string, unknown> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function text(value: unknown): string {
  return value === undefined || value === null ? "–" : written(value);
}
