/** The matrix of cogency: what an edge between two labels means. An entry that is chosen becomes a rule of its own. */

import { choice, h, swatch } from "../../../dom";
import { t } from "../../../language";
import { COGENCIES, cogencyOf, withCogency, type RuleSetDraft } from "../../../labels/rule_set_draft";
import type { Cogency, CogencyMatrix, Label } from "../../../service/types";

export function cogencyTable(
  draft: RuleSetDraft,
  derived: CogencyMatrix,
  change: (draft: RuleSetDraft) => void,
): HTMLElement {
  const head = ({ name, color }: Label, scope: string): HTMLElement => h("th", { scope }, swatch(color), " ", name);
  const cell = (left: Label, right: Label): HTMLElement => {
    const values = [["", t("fromLabels")] as const, ...COGENCIES.map((value) => [value, value] as const)];
    const set = (value: string): void =>
      change(withCogency(draft, left.id, right.id, value === "" ? undefined : (value as Cogency)));
    const name = t("cogencyBetween", { left: left.name, right: right.name });
    return h(
      "td",
      {},
      choice(values, cogencyOf(draft, derived, left.id, right.id) ?? "", set, {
        "aria-label": name,
        id: `cogency-${left.id}-${right.id}`,
      }),
    );
  };
  return h(
    "div",
    { class: "scroll", tabindex: 0, role: "group", "aria-label": t("matrix") },
    h(
      "table",
      { class: "matrix" },
      h("thead", {}, h("tr", {}, h("td", {}), ...draft.labels.map((label) => head(label, "col")))),
      // The order of two labels makes no difference: one half says it all.
      h(
        "tbody",
        {},
        ...draft.labels.map((left, row) =>
          h("tr", {}, head(left, "row"), ...draft.labels.slice(0, row + 1).map((right) => cell(left, right))),
        ),
      ),
    ),
  );
}
