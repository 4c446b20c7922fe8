/** What is different between two states of the storage locations of one map, by their codes. */

import type { Point } from "../../../map/frame";
import type { ShownChanges } from "./location_changes";

/** How far a place lies from where it was to have moved, metres: two cells of a usual map. */
const MOVED_M = 0.1;

/** Centres of the locations by code. */
export type Places = ReadonlyMap<string, Point>;

export function changesByCode(before: Places, now: Places): ShownChanges {
  const only = (these: Places, others: Places) =>
    [...these].filter(([code]) => !others.has(code)).map(([code, centre]) => ({ code, centre: [...centre] }));
  const changed = [...now].flatMap(([code, centre]) => {
    const was = before.get(code);
    const isMoved = was !== undefined && Math.hypot(centre[0] - was[0], centre[1] - was[1]) > MOVED_M;
    return isMoved ? [{ code, codeBefore: code, changes: ["moved" as const], centre: [...centre] }] : [];
  });
  return { added: only(now, before), removed: only(before, now), changed };
}
