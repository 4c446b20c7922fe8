/** The editor of a rule set: labels, what they are for, what they connect to, and the matrix of cogency. */

import { button, field, h, replace } from "../../../dom";
import { t } from "../../../language";
import { documentOf, draftOf, type RuleSetDraft } from "../../../labels/rule_set_draft";
import { clear, problemBox, show } from "../../../parts/problem";
import { get, getTagged, send } from "../../../service/request";
import type { CogencyMatrix, RuleSet } from "../../../service/types";
import { cogencyTable } from "./cogency_table";
import { labelTable } from "./label_table";

/** Opens the editor for a rule set; tells the id of what was saved. */
export async function editRuleSet(id: string, saved: (id: string) => Promise<void>): Promise<void> {
  const path = `v1/rule-sets/${encodeURIComponent(id)}`;
  const [{ body: ruleSet, tag }, derived] = await Promise.all([
    getTagged<RuleSet>(path),
    get<CogencyMatrix>(`${path}/matrix`),
  ]);
  const problems = problemBox();
  const content = h("div", {});
  let draft = draftOf(ruleSet);

  const change = (next: RuleSetDraft): void => {
    draft = next;
    const focused = document.activeElement?.id;
    update();
    if (focused) document.getElementById(focused)?.focus();
  };
  const update = (): void =>
    replace(
      content,
      labelTable(draft, change),
      h("h3", {}, t("matrix")),
      h("p", {}, h("small", {}, t("matrixMeaning"))),
      cogencyTable(draft, derived, change),
    );

  const name = h("input", { type: "text", value: draft.id });
  const save = async (): Promise<void> => {
    clear(problems);
    const document = documentOf({ ...draft, id: name.value.trim() });
    try {
      if (!ruleSet.builtIn && document.id === ruleSet.id) await send("PUT", path, document, tag);
      else await send("POST", "v1/rule-sets", document);
      dialog.close();
      await saved(document.id);
    } catch (error) {
      show(problems, error);
    }
  };
  const add = (): void => {
    const id = `l${draft.labels.length + 1}`;
    change({
      ...draft,
      labels: [...draft.labels, { id, name: "", color: "#888888", functionality: [], connectsTo: [] }],
    });
  };
  update();
  const dialog = h(
    "dialog",
    { class: "wide", "aria-labelledby": "rules-title" },
    h("h2", { id: "rules-title" }, t("editRules")),
    ruleSet.builtIn && h("p", {}, t("builtIn", { id: ruleSet.id })),
    field(t("ruleSetId"), name, t("ruleSetIdMeaning")),
    content,
    problems,
    h(
      "div",
      { class: "actions" },
      button(t("addLabel"), add),
      button(t("cancel"), () => dialog.close()),
      button(t("saveRules"), () => void save(), { class: "primary" }),
    ),
  );
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}
