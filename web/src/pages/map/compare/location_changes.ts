/** What changed about storage locations, in words. */

import { t } from "../../../language";
import type { Point } from "../../../map/frame";
import { COLORS } from "../../../map/look";
import type { LocationChanges } from "../../../service/types";
import type { ChangeGroup } from "../change_list";

/** Groups of changes; `place` leads from the coordinates of the answer to the shown map. */
export function locationGroups(
  { added, removed, changed }: LocationChanges,
  place: (position: Point) => Point,
): ChangeGroup[] {
  const at = (centre: readonly number[]): Point => place([centre[0] ?? 0, centre[1] ?? 0]);
  const marks = (list: LocationChanges["added"]) =>
    list.map(({ code, centre }) => ({ text: code, position: at(centre) }));
  return [
    { title: t("locationsAdded"), color: COLORS.added, changes: marks(added) },
    { title: t("locationsRemoved"), color: COLORS.removed, changes: marks(removed) },
    {
      title: t("locationsChanged"),
      color: COLORS.changed,
      changes: changed.map(({ code, codeBefore, changes, centre }) => ({
        text: `${codeBefore === code ? code : `${codeBefore} → ${code}`}: ${changes.map((word) => t(word)).join(", ")}`,
        position: at(centre),
      })),
    },
  ];
}
