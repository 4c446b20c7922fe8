/** The labels of a rule set as a table of fields. */

import { button, h } from "../../../dom";
import { t } from "../../../language";
import { FUNCTIONALITIES, toggled, withLabel, type RuleSetDraft } from "../../../labels/rule_set_draft";
import type { Label } from "../../../service/types";

export function labelTable(draft: RuleSetDraft, change: (draft: RuleSetDraft) => void): HTMLElement {
  const heads = [t("labelId"), t("name"), t("color"), t("isFor"), t("connectsTo"), ""];
  return h(
    "div",
    { class: "scroll", tabindex: 0, role: "group", "aria-label": t("labels") },
    h(
      "table",
      { class: "labels-table" },
      h("thead", {}, h("tr", {}, ...heads.map((head) => (head ? h("th", { scope: "col" }, head) : h("td", {}))))),
      h("tbody", {}, ...draft.labels.map((label, index) => row(draft, label, index, change))),
    ),
  );
}

function row(draft: RuleSetDraft, label: Label, index: number, change: (draft: RuleSetDraft) => void): HTMLElement {
  const set = (part: Partial<Label>): void => change(withLabel(draft, index, part));
  const text = (name: "id" | "name" | "color", type: string, title: string): HTMLElement => {
    const input = h("input", {
      type,
      value: label[name],
      id: `${name}-${index}`,
      "aria-label": `${title} ${index + 1}`,
      onchange: () => set({ [name]: input.value }),
    });
    return input;
  };
  const boxes = (
    name: "functionality" | "connectsTo",
    values: readonly (readonly [value: string, title: string])[],
  ): HTMLElement[] =>
    values.map(([value, title]) => {
      const list = label[name] as readonly string[] | undefined;
      const box = h("input", {
        type: "checkbox",
        checked: list?.includes(value) ?? false,
        id: `${name}-${index}-${value}`,
        onchange: () => set({ [name]: toggled(list, value, box.checked) } as Partial<Label>),
      });
      return h("label", { class: "line" }, box, title);
    });
  const remove = (): void => change({ ...draft, labels: draft.labels.filter((_, at) => at !== index) });
  return h(
    "tr",
    {},
    h("td", {}, text("id", "text", t("labelId"))),
    h("td", {}, text("name", "text", t("name"))),
    h("td", {}, text("color", "color", t("color"))),
    h(
      "td",
      {},
      ...boxes(
        "functionality",
        FUNCTIONALITIES.map((value) => [value, value]),
      ),
    ),
    h(
      "td",
      {},
      ...boxes(
        "connectsTo",
        draft.labels.map(({ id, name }) => [id, name || id]),
      ),
    ),
    h("td", {}, button("×", remove, { "aria-label": t("remove", { name: label.name || label.id }) })),
  );
}
