/** What the browser keeps for this page: it outlives a closed page and a service that is gone. */

/** What was stored under a key; nothing where it cannot be read. */
export function readStored<T>(key: string): T | undefined {
  try {
    return (JSON.parse(localStorage.getItem(key) ?? "null") as T | null) ?? undefined;
  } catch {
    // No page of today wrote it.
    return undefined;
  }
}

/** Stores a value, or takes away what was stored. */
export function writeStored(key: string, value: unknown): void {
  if (value === undefined) localStorage.removeItem(key);
  else localStorage.setItem(key, JSON.stringify(value));
}
