/** Which rule set reads the map, and the way to the editor. */

import { button, choice, field, h, replace } from "../../../dom";
import { t } from "../../../language";
import { get } from "../../../service/request";
import type { RuleSet } from "../../../service/types";
import type { Workspace } from "../workspace";
import { editRuleSet } from "./rule_set_editor";

export function ruleSetChoice(workspace: Workspace, saved: () => Promise<void>): HTMLElement {
  const { labels, failed } = workspace;
  const place = h("div", {}, chooser([labels.ruleSet]));

  function chooser(ruleSets: readonly RuleSet[]): HTMLElement {
    const wanted = labels.draft.ruleSet ?? labels.inForce.ruleSet;
    const names = ruleSets.map(({ id }) => [id, id] as const);
    const choose = (id: string): void => {
      const { ruleSet: _, ...others } = labels.draft;
      labels.draft = id === labels.inForce.ruleSet ? others : { ...others, ruleSet: id };
    };
    const edited = async (id: string): Promise<void> => {
      await labels.reread();
      if (id !== labels.inForce.ruleSet) choose(id);
      await saved();
    };
    return h(
      "div",
      {},
      field(
        t("ruleSet"),
        choice(names, wanted, choose, { id: "rule-set" }),
        labels.draft.ruleSet === undefined ? undefined : t("ruleSetDrafted"),
      ),
      button(t("editRules"), () => void editRuleSet(wanted, edited).catch(failed)),
    );
  }

  get<{ ruleSets: RuleSet[] }>("v1/rule-sets").then(({ ruleSets }) => replace(place, chooser(ruleSets)), failed);
  return place;
}
