/** The editor of a rule set: labels, what they are for, what they connect to, and the matrix of cogency. */

import { button, field, h, replace } from "../../../dom";
import { t } from "../../../language";
import type { DraftedRules } from "../../../labels/draft";
import { documentOf, draftOf, editable, type RuleSetDraft } from "../../../labels/rule_set_draft";
import { get, getTagged } from "../../../service/request";
import type { CogencyMatrix, RuleSet } from "../../../service/types";
import { cogencyTable } from "./cogency_table";
import { labelTable } from "./label_table";

/** The rule set that every service has. */
const BUILT_IN = "site";

/** Opens the editor for a rule set, or for a draft of one; tells what is to be tried on the map. */
export async function editRuleSet(
  id: string,
  drafted: DraftedRules | undefined,
  wanted: (rules: DraftedRules) => void,
): Promise<void> {
  const isUnsaved = drafted !== undefined && !drafted.isStored;
  // What is new has no stored one to begin with.
  const path = `v1/rule-sets/${encodeURIComponent(isUnsaved && drafted.replaces === undefined ? BUILT_IN : id)}`;
  const [{ body: ruleSet, tag }, derived] = await Promise.all([
    getTagged<RuleSet>(path),
    get<CogencyMatrix>(`${path}/matrix`),
  ]);
  const content = h("div", {});
  let draft = isUnsaved ? editable(drafted.document) : draftOf(ruleSet);

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
  const tryOut = (): void => {
    const document = documentOf({ ...draft, id: name.value.trim() });
    const isReplaced = !ruleSet.builtIn && document.id === ruleSet.id;
    const replaces =
      isUnsaved && document.id === drafted.document.id ? (drafted.replaces ?? "") : isReplaced ? tag : "";
    dialog.close();
    wanted({ document, isStored: false, ...(replaces === "" ? {} : { replaces }) });
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
    h("p", {}, h("small", {}, t("tryRulesMeaning"))),
    h(
      "div",
      { class: "actions" },
      button(t("addLabel"), add),
      button(t("cancel"), () => dialog.close()),
      button(t("tryRules"), tryOut, { class: "primary" }),
    ),
  );
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}
