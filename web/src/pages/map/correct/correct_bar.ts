/** Saving corrections as a version, steps back and forth. Where somebody else saved meanwhile, their change is shown first. */

import { button, h, replace } from "../../../dom";
import type { Corrections } from "../../../corrections/corrections";
import type { TheirChange } from "../../../corrections/draft";
import { t } from "../../../language";
import { Refused } from "../../../service/request";
import type { Workspace } from "../workspace";
import { described } from "./words";

export interface CorrectBar {
  readonly element: HTMLElement;
  update(): void;
  save(): void;
  step(by: "undo" | "redo"): void;
}

export function correctBar(workspace: Workspace, corrections: Corrections, saved: () => Promise<void>): CorrectBar {
  const { labels, failed } = workspace;
  const conflict = h("div", { role: "alert" });
  const count = h("span", { role: "status" });
  const save = button(t("save"), () => run(() => corrections.save()), { class: "primary" });
  const discard = button(t("discard"), () => corrections.discard());
  const undo = button(t("undo"), () => step("undo"), { "aria-keyshortcuts": "Control+Z" });
  const redo = button(t("redo"), () => step("redo"), { "aria-keyshortcuts": "Control+Shift+Z" });

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
        const theirs = await corrections.reread();
        await saved();
        showConflict(theirs);
      }
    };
    work().catch(failed).finally(update);
  }

  function showConflict(theirs: readonly TheirChange[]): void {
    const name = (id: string): string => labels.label(id)?.name ?? id;
    const lines = theirs.map(({ what, correction }) => `${t(THEIRS[what])}: ${described(correction, name)}`);
    replace(
      conflict,
      h(
        "div",
        { class: "problem" },
        h("strong", {}, t("conflict")),
        h("ul", {}, ...(lines.length > 0 ? lines : [t("labelsChanged")]).map((text) => h("li", {}, text))),
        h("p", {}, t("conflictMeaning")),
      ),
    );
  }

  /** A step in the draft where it has one, else over the saved versions. */
  function step(by: "undo" | "redo"): void {
    if (by === "undo" && corrections.canUndoDraft) corrections.undoDraft();
    else if (by === "redo" && corrections.canRedoDraft) corrections.redoDraft();
    else if (corrections.count === 0) run(() => corrections.step(by));
  }

  function update(): void {
    const changes = corrections.count;
    replace(count, changes === 0 ? t("version", { version: corrections.version }) : t("changes", { count: changes }));
    [save.disabled, discard.disabled] = [changes === 0, changes === 0];
    undo.disabled = !corrections.canUndoDraft && (changes > 0 || !labels.canUndo);
    redo.disabled = !corrections.canRedoDraft && (changes > 0 || !labels.canRedo);
  }

  // A draft that was kept in the browser can be older than what is in force.
  if (corrections.count > 0 && corrections.draft.version !== corrections.version) {
    corrections.reread().then(() => showConflict([]), failed);
  }
  return {
    element: h("div", {}, conflict, h("div", { class: "line" }, save, discard, undo, redo), count),
    update,
    save: () => run(() => corrections.save()),
    step,
  };
}

const THEIRS = { added: "theyAdded", removed: "theyRemoved", changed: "theyChanged" } as const;
