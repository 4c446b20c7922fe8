/** Changes to the labels of a map that are not saved yet. */

import type { Point } from "../map/frame";
import type { Semantics } from "../service/types";
import type { RuleSetDocument } from "./rule_set_draft";

/** A rule set that is to read the map. */
export interface DraftedRules {
  readonly document: RuleSetDocument;
  /** Whether the service has it as it is here. */
  readonly isStored: boolean;
  /** The tag of the stored one that it replaces; a new one where it is absent. */
  readonly replaces?: string;
}

export interface Draft {
  /** The version it was begun on. */
  readonly version: number;
  readonly rules?: DraftedRules;
  /** Label by category. */
  readonly assignment: Readonly<Record<string, string>>;
  /** Label by face; null gives a face that of its category again. */
  readonly overrides: Readonly<Record<string, string | null>>;
  /** A point inside each of these faces, metres: corrections number faces anew. */
  readonly places: Readonly<Record<string, Point>>;
}

export function emptyDraft(version: number): Draft {
  return { version, assignment: {}, overrides: {}, places: {} };
}

export function isEmpty(draft: Draft): boolean {
  return changeCount(draft) === 0;
}

export function changeCount(draft: Draft): number {
  return (
    Object.keys(draft.assignment).length + Object.keys(draft.overrides).length + (draft.rules === undefined ? 0 : 1)
  );
}

/** The merge patch that saves a draft whose rule set is stored. */
export function patchOf({ rules, assignment, overrides }: Draft): Record<string, unknown> {
  return {
    ...(rules === undefined ? {} : { ruleSet: rules.document.id }),
    ...(Object.keys(assignment).length > 0 ? { assignment } : {}),
    ...(Object.keys(overrides).length > 0 ? { overrides } : {}),
  };
}

/** The body that previews a draft: a rule set that is not stored is sent whole. */
export function previewOf(draft: Draft): Record<string, unknown> {
  const isSentWhole = draft.rules !== undefined && !draft.rules.isStored;
  return isSentWhole ? { ...patchOf(draft), ruleSet: draft.rules.document } : patchOf(draft);
}

/** The draft over faces that were numbered anew; `faceAt` tells the face at a point. What lies on no face any more goes. */
export function renumbered(draft: Draft, faceAt: (point: Point) => number | undefined): Draft {
  const [overrides, places]: [Record<string, string | null>, Record<string, Point>] = [{}, {}];
  for (const [face, label] of Object.entries(draft.overrides)) {
    const point = draft.places[face];
    const now = point ? faceAt(point) : Number(face);
    if (now === undefined) continue;
    overrides[now] = label;
    if (point) places[now] = point;
  }
  const isSame = Object.keys(overrides).sort().join() === Object.keys(draft.overrides).sort().join();
  return isSame ? draft : { ...draft, overrides, places };
}

/** The label of a face under a draft. `read` is the label that the service told. */
export function labelUnder(
  draft: Draft,
  inForce: Semantics,
  face: { id: number; category: number },
  read: string,
): string {
  const wanted = draft.overrides[face.id];
  if (typeof wanted === "string") return wanted;
  const isOverridden = inForce.overrides.some((override) => override.face === face.id);
  const category = draft.assignment[face.category];
  if (isOverridden && wanted !== null) return read;
  return category ?? (isOverridden ? (inForce.assignment[face.category] ?? read) : read);
}

/** What somebody else changed between two states, in words of the assignment: `category 3: co → ju`. */
export interface Difference {
  readonly what: "category" | "face" | "ruleSet";
  readonly key: string;
  readonly before: string;
  readonly after: string;
}

export function differences(before: Semantics, after: Semantics): Difference[] {
  const list: Difference[] = [];
  if (before.ruleSet !== after.ruleSet)
    list.push({ what: "ruleSet", key: "", before: before.ruleSet, after: after.ruleSet });
  const compare = (what: "category" | "face", old: Record<string, string>, now: Record<string, string>): void => {
    for (const key of new Set([...Object.keys(old), ...Object.keys(now)])) {
      const [was, is] = [old[key] ?? "", now[key] ?? ""];
      if (was !== is) list.push({ what, key, before: was, after: is });
    }
  };
  const byFace = (semantics: Semantics) =>
    Object.fromEntries(semantics.overrides.map(({ face, label }) => [face, label]));
  compare("category", before.assignment, after.assignment);
  compare("face", byFace(before), byFace(after));
  return list;
}
