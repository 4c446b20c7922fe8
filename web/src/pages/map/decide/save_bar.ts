/** Saving the draft as a version, undo and redo. Where somebody else saved meanwhile, their change is shown first. */

import { button, h, replace } from "../../../dom";
import { t } from "../../../language";
import { changeCount, differences, type Difference } from "../../../labels/draft";
import { get, Refused } from "../../../service/request";
import type { Semantics } from "../../../service/types";
import type { Workspace } from "../workspace";

export function saveBar(
  workspace: Workspace,
  saved: () => Promise<void>,
): { readonly element: HTMLElement; update(): void } {
  const { map, labels, failed } = workspace;
  const conflict = h("div", { role: "alert" });
  const count = h("span", { role: "status" });
  const save = button(t("save"), () => run(() => labels.save()), { class: "primary" });
  const discard = button(t("discard"), () => labels.discard());
  const undo = button(t("undo"), () => run(() => labels.step("undo")));
  const redo = button(t("redo"), () => run(() => labels.step("redo")));

  function run(act: () => Promise<void>): void {
    replace(conflict);
    workspace.clearProblems();
    for (const one of [save, undo, redo]) one.disabled = true;
    const work = async (): Promise<void> => {
      try {
        await act();
        await saved();
      } catch (error) {
        if (!(error instanceof Refused && error.status === 412)) throw error;
        await showConflict();
      }
    };
    work().catch(failed).finally(update);
  }

  /** Somebody else was faster: shows what they changed; the draft stays, and lies over theirs from now on. */
  async function showConflict(): Promise<void> {
    await labels.reread();
    const before = await get<Semantics>(`v1/maps/${map.id}/semantics/versions/${labels.draft.version}`);
    const theirs = differences(before, labels.inForce);
    labels.draft = { ...labels.draft, version: labels.inForce.version };
    await saved();
    replace(
      conflict,
      h(
        "div",
        { class: "problem" },
        h("strong", {}, t("conflict")),
        h("ul", {}, ...(theirs.length > 0 ? theirs.map(told) : [t("changedRules")]).map((text) => h("li", {}, text))),
        h("p", {}, t("conflictMeaning")),
      ),
    );
  }

  function told({ what, key, before, after }: Difference): string {
    const name = (id: string): string => labels.label(id)?.name ?? (id === "" ? "–" : id);
    return t(what === "category" ? "changedCategory" : what === "face" ? "changedFace" : "changedRuleSet", {
      key,
      before: name(before),
      after: name(after),
    });
  }

  function update(): void {
    const changes = changeCount(labels.draft);
    replace(
      count,
      changes === 0 ? t("version", { version: labels.inForce.version }) : t("changes", { count: changes }),
    );
    [save.disabled, discard.disabled] = [changes === 0, changes === 0];
    [undo.disabled, redo.disabled] = [changes > 0 || !labels.canUndo, changes > 0 || !labels.canRedo];
  }

  // A draft that was kept in the browser can be older than what is in force.
  if (changeCount(labels.draft) > 0 && labels.draft.version !== labels.inForce.version) showConflict().catch(failed);
  const element = h("div", {}, conflict, h("div", { class: "line" }, save, discard, undo, redo), count);
  return { element, update };
}
