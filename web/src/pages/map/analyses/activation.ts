/** Putting another analysis in force, after a question that tells what would be lost by it, and the way back. */

import { button, h } from "../../../dom";
import { t } from "../../../language";
import { confirm } from "../../../parts/confirm";
import { clear, problemBox, show } from "../../../parts/problem";
import { get, send } from "../../../service/request";
import type { Analysis } from "../../../service/types";
import type { Workspace } from "../workspace";

/** The button that puts an analysis in force; `done` is told once it is. */
export function activation(workspace: Workspace, id: string, done: () => Promise<void>): HTMLElement {
  return act(t("activate"), "primary", async () => {
    const { wouldCarry } = await get<Analysis>(`v1/maps/${workspace.map.id}/analyses/${id}`);
    const lost = wouldCarry?.lost.length ?? 0;
    const meaning = `${t("activateMeaning")} ${lost > 0 ? t("activateLoses", { lost }) : t("activateKeeps")}`;
    if (!(await confirm(t("activateQuestion"), meaning, t("activate"), false))) return;
    await putInForce(workspace, id);
    await done();
  });
}

/** Says that another analysis is in force than the one with this id, and leads back to it. */
export function wayBack(workspace: Workspace, id: string, done: () => Promise<void>): HTMLElement {
  const undo = act(t("undo"), "", async () => {
    await putInForce(workspace, id);
    await done();
  });
  return h("div", { class: "card line" }, t("analysisInForce"), undo);
}

/** A button with what went wrong above it; it cannot be pressed again before its work is done. */
function act(text: string, look: string, work: () => Promise<void>): HTMLElement {
  const problems = problemBox();
  const pressed = button(
    text,
    () => {
      clear(problems);
      pressed.disabled = true;
      work()
        .catch((error: unknown) => show(problems, error))
        .finally(() => (pressed.disabled = false));
    },
    { class: look },
  );
  return h("div", {}, problems, pressed);
}

async function putInForce({ map, labels, collections }: Workspace, id: string): Promise<void> {
  await send("POST", `v1/maps/${map.id}/analyses/${id}/activate`, undefined);
  await Promise.all([labels.reread(), collections.refresh()]);
}
