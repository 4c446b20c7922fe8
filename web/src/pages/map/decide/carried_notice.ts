/** What became of labels that came from another analysis or an earlier scan, where some were lost. */

import { h } from "../../../dom";
import { t } from "../../../language";
import type { Point } from "../../../map/frame";
import { lostLabels } from "../carried_labels";
import { changeGroup } from "../change_list";
import type { Workspace } from "../workspace";

/** Metres around a place that is flown to. */
const MARGIN = 6;

export function carriedNotice({ labels, canvas }: Workspace): HTMLElement | undefined {
  const { carried } = labels.inForce;
  if (!carried || carried.lost.length === 0) return undefined;
  const fly = ([x, y]: Point): void => canvas.fit([x - MARGIN, y - MARGIN, x + MARGIN, y + MARGIN], 300);
  const name = (label: string): string => labels.label(label)?.name ?? label;
  return h(
    "div",
    { class: "card list" },
    h("p", {}, t(carried.map ? "carriedFromMap" : "carriedFromAnalysis", { kept: carried.kept })),
    changeGroup(lostLabels(carried, t("labelsNotKept"), name), fly),
  );
}
