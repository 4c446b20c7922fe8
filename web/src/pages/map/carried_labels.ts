/** Labels that people gave and that another analysis, or another scan, could not keep: each with its place. */

import { t } from "../../language";
import { COLORS } from "../../map/look";
import type { CarriedLabels } from "../../service/types";
import type { ChangeGroup } from "./change_list";

/** The group of what was lost; `name` tells the name of a label. */
export function lostLabels({ lost }: CarriedLabels, title: string, name: (label: string) => string): ChangeGroup {
  return {
    title,
    color: COLORS.removed,
    changes: lost.map(({ face, category, label, at: [x = 0, y = 0] }) => ({
      text:
        typeof face === "number"
          ? t("lostOfFace", { face, label: name(label) })
          : t("lostOfCategory", { category: category ?? "", label: name(label) }),
      position: [x, y],
    })),
  };
}
