/**
 * Undo and redo over versions. A version that is restored becomes a new one: what is undone is told by the contents that
 * followed one another, each by the version that has it.
 */

export interface Track {
  /** Versions with the contents in their order. */
  readonly contents: readonly number[];
  /** Which of them is in force. */
  readonly position: number;
}

/** The track of a map whose versions are known: each content followed the one before. */
export function trackOf(inForce: number): Track {
  return { contents: Array.from({ length: inForce + 1 }, (_, version) => version), position: inForce };
}

/** A new content is in force: what was undone before is gone. */
export function changed({ contents, position }: Track, version: number): Track {
  return { contents: [...contents.slice(0, position + 1), version], position: position + 1 };
}

/** The version to restore for a step back (-1) or forth (1), and the track after it. */
export function step(
  { contents, position }: Track,
  by: -1 | 1,
): { readonly version: number; readonly track: Track } | undefined {
  const version = contents[position + by];
  return version === undefined ? undefined : { version, track: { contents, position: position + by } };
}
