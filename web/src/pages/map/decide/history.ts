/** The versions of the labels: who decided, when, and the way back to each. */

import { button, h, replace } from "../../../dom";
import { moment, t } from "../../../language";
import { differences } from "../../../labels/draft";
import { get } from "../../../service/request";
import type { Semantics } from "../../../service/types";
import type { Workspace } from "../workspace";

/** Who decided, by the name of its text. */
const ORIGINS = { suggested: "bySuggestion", assigned: "byPerson", carried: "byCarrying" } as const;

export function historyList(workspace: Workspace, isOpen: boolean, restored: () => Promise<void>): HTMLElement {
  const { map, labels, failed } = workspace;
  const list = h("ul", { class: "list" });
  const element = h("details", { class: "history", open: isOpen }, h("summary", {}, t("history")), list);

  async function read(): Promise<void> {
    const path = `v1/maps/${map.id}/semantics/versions`;
    // The list has what people decided; before all of it comes the suggestion.
    const [decided, suggestion] = await Promise.all([
      get<{ versions: Semantics[] }>(path),
      get<Semantics>(`${path}/0`),
    ]);
    const versions = [...decided.versions, suggestion];
    replace(list, ...versions.map((version, index) => line(version, versions[index + 1])));
  }

  function line(version: Semantics, before: Semantics | undefined): HTMLElement {
    const origin = t(ORIGINS[version.origin]);
    const changes = before ? t("changes", { count: differences(before, version).length }) : "";
    const { correctionCount } = version;
    const corrected = correctionCount > 0 ? t("correctionCount", { count: correctionCount }) : "";
    const restore = (): void => void labels.restore(version.version).then(restored).catch(failed);
    return h(
      "li",
      {},
      `${version.version} · ${moment(version.created)} · ${origin} ${changes} ${corrected} `,
      version.version !== labels.inForce.version &&
        button(t("restore"), restore, { "aria-label": t("restoreOne", { version: version.version }) }),
    );
  }

  element.addEventListener("toggle", () => element.open && read().catch(failed));
  return element;
}
