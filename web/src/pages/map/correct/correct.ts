/** Correcting what the analysis got wrong: drawing over the map, as a list of corrections that is saved as a version. */

import { h, replace } from "../../../dom";
import { Corrections } from "../../../corrections/corrections";
import { t } from "../../../language";
import { onConnection } from "../../../service/connection";
import { get } from "../../../service/request";
import type { Diagnostics } from "../../../service/types";
import type { OpenTool, Tool, Workspace } from "../workspace";
import { desk } from "./desk";

export const correct: Tool = { id: "correct", name: "correct", open };

function open(workspace: Workspace): OpenTool {
  const content = h("div", {});
  let opened: OpenTool | undefined;
  let isClosed = false;

  async function begin(): Promise<void> {
    const [corrections, { orientations, frame }] = await Promise.all([
      Corrections.of(workspace.map.id),
      get<Diagnostics>(`v1/maps/${workspace.map.id}/diagnostics`),
    ]);
    if (isClosed || opened) return;
    workspace.clearProblems();
    // The orientations are those of the grid.
    opened = desk(
      workspace,
      corrections,
      orientations.anglesRad.map((angle) => angle + frame.yawRad),
    );
    replace(content, opened.element);
  }

  const start = (): void => void begin().catch(workspace.failed);
  const stopWaiting = onConnection((isGone) => !isGone && start());
  start();
  return {
    element: h("div", {}, h("p", {}, h("small", {}, t("correctMeaning"))), content),
    click: (point, features) => opened?.click?.(point, features),
    key: (event) => opened?.key?.(event),
    close: () => {
      isClosed = true;
      stopWaiting();
      opened?.close();
    },
  };
}
