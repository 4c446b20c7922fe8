/** The corrections in their order: what each does, whether it fits, and the way to it. */

import { button, h } from "../../../dom";
import type { Wanted } from "../../../corrections/draft";
import { t } from "../../../language";
import { described } from "./words";

/** Lines that are shown; those that do not fit come first. */
const MOST = 200;

export interface ListEvents {
  readonly chosen: string | undefined;
  /** Why the one at a place of the list does not fit. */
  misfit(index: number): string | undefined;
  labelName(id: string): string;
  choose(key: string): void;
  remove(key: string): void;
}

export function correctionList(wanted: readonly Wanted[], events: ListEvents): HTMLElement {
  const lines = wanted.map((one, index) => ({ ...one, misfit: events.misfit(index) }));
  const sorted = [...lines.filter(({ misfit }) => misfit), ...lines.filter(({ misfit }) => !misfit)];
  return h(
    "section",
    { class: "list corrections", "aria-labelledby": "corrections-title" },
    h("h2", { id: "corrections-title" }, `${t("corrections")}: ${wanted.length}`),
    wanted.length === 0 && h("p", {}, h("small", {}, t("noCorrections"))),
    h("ul", {}, ...sorted.slice(0, MOST).map((one) => line(one, one.misfit, events))),
    sorted.length > MOST && h("p", {}, t("moreChanges", { count: sorted.length - MOST })),
  );
}

function line({ key, correction, isDrafted }: Wanted, misfit: string | undefined, events: ListEvents): HTMLElement {
  const text = described(correction, events.labelName);
  return h(
    "li",
    { class: key === events.chosen ? "chosen" : null },
    button(text, () => events.choose(key), {
      id: `correction ${key}`,
      "aria-current": key === events.chosen ? "true" : null,
    }),
    isDrafted && h("small", {}, ` ${t("notSaved")}`),
    " ",
    button("×", () => events.remove(key), { "aria-label": t("remove", { name: text }) }),
    misfit && h("p", { class: "warning" }, `${t("doesNotFit")}: ${misfit}`),
  );
}
