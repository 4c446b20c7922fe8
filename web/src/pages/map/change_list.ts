/** What changed, group by group, each line with its place on the map. */

import { button, h } from "../../dom";
import { t } from "../../language";
import type { Point } from "../../map/frame";

/** Lines of a group that are shown. */
const MOST = 100;

/** One thing that changed. */
export interface Change {
  readonly text: string;
  /** Where, metres of the shown map; unknown where nothing is drawn there any more. */
  readonly position: Point | undefined;
}

export interface ChangeGroup {
  readonly title: string;
  readonly color: string;
  readonly changes: readonly Change[];
}

export function changeList(groups: readonly ChangeGroup[], fly: (position: Point) => void): HTMLElement {
  const count = groups.reduce((sum, { changes }) => sum + changes.length, 0);
  return h(
    "div",
    { class: "list", "aria-live": "polite" },
    h("p", {}, h("strong", {}, count === 0 ? t("nothingChanged") : t("changes", { count }))),
    ...groups.filter(({ changes }) => changes.length > 0).map((group) => changeGroup(group, fly)),
  );
}

/** One group, folded open. */
export function changeGroup({ title, color, changes }: ChangeGroup, fly: (position: Point) => void): HTMLElement {
  const dot = h("span", { class: "swatch", "aria-hidden": "true" });
  dot.style.backgroundColor = color;
  const line = ({ text, position }: Change): HTMLElement =>
    h("li", {}, position ? button(text, () => fly(position)) : text);
  return h(
    "details",
    { open: true },
    h("summary", {}, dot, ` ${title}: ${changes.length}`),
    h("ul", {}, ...changes.slice(0, MOST).map(line)),
    changes.length > MOST && h("p", {}, t("moreChanges", { count: changes.length - MOST })),
  );
}
