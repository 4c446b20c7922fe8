/** The analyses of a map: which one is in force, another one with other options, and the way to put it in force. */

import { ofMap, read, withValue } from "../../../address";
import { h, replace } from "../../../dom";
import { moment, t } from "../../../language";
import { get } from "../../../service/request";
import type { Analysis } from "../../../service/types";
import type { OpenTool, Tool, Workspace } from "../workspace";
import { activation, wayBack } from "./activation";
import { againForm } from "./again_form";
import { optionList } from "./option_list";

export const analyses: Tool = { id: "analyses", name: "analyses", open };

function open(workspace: Workspace): OpenTool {
  const { map, failed } = workspace;
  const notice = h("div", { role: "status" });
  const list = h("ol", { class: "analyses" });
  const again = againForm(workspace, show);

  /** Reads the analyses; the one that was made just now is marked. */
  async function show(made?: string): Promise<void> {
    const { analyses } = await get<{ analyses: Analysis[] }>(`v1/maps/${map.id}/analyses`);
    const inForce = analyses.find((one) => one.inForce);
    if (!inForce) return;
    replace(list, ...analyses.map((one) => line(one, inForce, one.id === made)));
    again.offer(analyses);
    list.querySelector<HTMLElement>(".made")?.focus();
  }

  function line(one: Analysis, inForce: Analysis, isMade: boolean): HTMLElement {
    const name = h("strong", {}, t("analysisOf", { moment: moment(one.created) }));
    if (one.inForce) return h("li", { class: "card" }, name, h("p", { class: "good" }, t("isInForce")));
    const compared = withValue(read(location.hash).view, "with", `analysis ${one.id}`);
    const activated = async (): Promise<void> => {
      replace(notice, wayBack(workspace, inForce.id, undone));
      await show();
    };
    return h(
      "li",
      { class: isMade ? "card made" : "card", tabindex: isMade ? -1 : null },
      name,
      isMade && h("p", { class: "good" }, t("isProposal")),
      optionList(inForce.options, one.options),
      h(
        "div",
        { class: "line" },
        h("a", { href: ofMap(map.id, "compare", compared) }, t("compareWithInForce")),
        activation(workspace, one.id, activated),
      ),
    );
  }

  async function undone(): Promise<void> {
    replace(notice);
    await show();
  }

  show().catch(failed);
  return {
    element: h(
      "section",
      { "aria-label": t("analyses") },
      h("p", {}, h("small", {}, t("analysesMeaning"))),
      notice,
      list,
      again.element,
    ),
    close: again.close,
  };
}
