/** Corrections that are not saved yet: what was added, changed and removed over the list of a version. */

import { plain, type Correction, type Listed } from "./correction";

export interface CorrectionDraft {
  /** The version it was begun on. */
  readonly version: number;
  readonly added: readonly Correction[];
  /** By the id of the correction in the list. */
  readonly changed: Readonly<Record<string, Correction>>;
  readonly removed: readonly string[];
}

/** A correction of the wanted list. */
export interface Wanted {
  /** Its id, or `new N` for the Nth that was added. */
  readonly key: string;
  readonly id?: string;
  readonly correction: Correction;
  /** Whether it differs from what is saved. */
  readonly isDrafted: boolean;
}

export function emptyDraft(version: number): CorrectionDraft {
  return { version, added: [], changed: {}, removed: [] };
}

export function changeCount({ added, changed, removed }: CorrectionDraft): number {
  return added.length + Object.keys(changed).length + removed.length;
}

/** The list as it would be. */
export function wantedList(listed: readonly Listed[], { added, changed, removed }: CorrectionDraft): Wanted[] {
  const kept = listed.filter(({ id = "" }) => !removed.includes(id));
  return [
    ...kept.map((one) => {
      const id = one.id ?? "";
      const drafted = changed[id];
      return { key: id, id, correction: drafted ?? plain(one), isDrafted: drafted !== undefined };
    }),
    ...added.map((correction, index) => ({ key: `new ${index}`, correction, isDrafted: true })),
  ];
}

/** What is sent to save or preview it. */
export function bodyOf(wanted: readonly Wanted[]): (Correction & { readonly id?: string })[] {
  return wanted.map(({ id, correction }) => (id === undefined ? correction : { ...correction, id }));
}

export function withAdded(draft: CorrectionDraft, corrections: readonly Correction[]): CorrectionDraft {
  return { ...draft, added: [...draft.added, ...corrections] };
}

export function withChanged(draft: CorrectionDraft, key: string, correction: Correction): CorrectionDraft {
  const index = newIndex(key);
  if (index === undefined) return { ...draft, changed: { ...draft.changed, [key]: correction } };
  return { ...draft, added: draft.added.map((one, at) => (at === index ? correction : one)) };
}

export function withRemoved(draft: CorrectionDraft, key: string): CorrectionDraft {
  const index = newIndex(key);
  if (index !== undefined) return { ...draft, added: draft.added.filter((_, at) => at !== index) };
  const { [key]: _, ...changed } = draft.changed;
  return { ...draft, changed, removed: [...draft.removed, key] };
}

/** The key of the correction that was added last. */
export function lastAdded({ added }: CorrectionDraft): string {
  return `new ${added.length - 1}`;
}

function newIndex(key: string): number | undefined {
  return key.startsWith("new ") ? Number(key.slice(4)) : undefined;
}

/** The draft over the list of a later version: what was changed there and is gone is added anew, so that nothing is lost. */
export function rebased(draft: CorrectionDraft, listed: readonly Listed[], version: number): CorrectionDraft {
  const ids = new Set(listed.map(({ id }) => id));
  const changes = Object.entries(draft.changed);
  return {
    version,
    added: [...changes.filter(([id]) => !ids.has(id)).map(([, correction]) => correction), ...draft.added],
    changed: Object.fromEntries(changes.filter(([id]) => ids.has(id))),
    removed: draft.removed.filter((id) => ids.has(id)),
  };
}

/** What somebody else did between two lists. */
export interface TheirChange {
  readonly what: "added" | "removed" | "changed";
  readonly correction: Correction;
}

export function theirChanges(before: readonly Listed[], now: readonly Listed[]): TheirChange[] {
  const old = new Map(before.map((one) => [one.id, one]));
  const ids = new Set(now.map(({ id }) => id));
  const text = (one: Listed): string => JSON.stringify(plain(one));
  return [
    ...now.flatMap((one): TheirChange[] => {
      const was = old.get(one.id);
      if (!was) return [{ what: "added", correction: one }];
      return text(was) === text(one) ? [] : [{ what: "changed", correction: one }];
    }),
    ...before.filter(({ id }) => !ids.has(id)).map((correction) => ({ what: "removed" as const, correction })),
  ];
}
