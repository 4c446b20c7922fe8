/** Which rule set reads the map, and the way to the editor. */

import { button, choice, field, h, replace } from "../../../dom";
import { t } from "../../../language";
import type { DraftedRules } from "../../../labels/draft";
import { documentOf, draftOf } from "../../../labels/rule_set_draft";
import { get } from "../../../service/request";
import type { RuleSet } from "../../../service/types";
import type { Workspace } from "../workspace";
import { editRuleSet } from "./rule_set_editor";

export function ruleSetChoice({ labels, failed }: Workspace): HTMLElement {
  const place = h("div", {}, chooser([labels.inForce.ruleSet]));

  function drafted(rules: DraftedRules | undefined): void {
    const { rules: _, ...others } = labels.draft;
    labels.draft = rules ? { ...others, rules } : others;
  }

  /** Reads the map with a stored rule set. */
  async function choose(id: string): Promise<void> {
    if (id === labels.inForce.ruleSet) return drafted(undefined);
    const ruleSet = await get<RuleSet>(`v1/rule-sets/${encodeURIComponent(id)}`);
    drafted({ document: { ...documentOf(draftOf(ruleSet)), id }, isStored: true });
  }

  function chooser(stored: readonly string[]): HTMLElement {
    const { rules } = labels.draft;
    const wanted = rules?.document.id ?? labels.inForce.ruleSet;
    const names = [...new Set([...stored, wanted])].map((id) => [id, id] as const);
    return h(
      "div",
      {},
      field(
        t("ruleSet"),
        choice(names, wanted, (id) => void choose(id).catch(failed), { id: "rule-set" }),
        rules === undefined ? undefined : t("ruleSetDrafted"),
      ),
      button(t("editRules"), () => void editRuleSet(wanted, rules, drafted).catch(failed)),
    );
  }

  get<{ ruleSets: RuleSet[] }>("v1/rule-sets").then(
    ({ ruleSets }) => replace(place, chooser(ruleSets.map(({ id }) => id))),
    failed,
  );
  return place;
}
