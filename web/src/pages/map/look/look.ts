/** Looking at a map: its figures, search by code or name, measuring. */

import { button, h } from "../../../dom";
import { number, t } from "../../../language";
import type { OpenTool, Tool, Workspace } from "../workspace";
import { measuring } from "./measure";
import { searchField } from "./search";
import { staleCodes } from "./stale_codes";

export const look: Tool = { id: "look", name: "look", open };

function open(workspace: Workspace): OpenTool {
  const { map, canvas } = workspace;
  const measure = measuring(workspace);
  const stale = staleCodes(workspace);
  const toggle = button(t("measure"), () => toggle.setAttribute("aria-pressed", String(measure.toggle())), {
    "aria-pressed": "false",
  });
  const size = t("size", {
    width: number(map.width * map.resolutionM, 1),
    height: number(map.height * map.resolutionM, 1),
    cell: number(map.resolutionM, 3),
  });
  const element = h(
    "div",
    {},
    searchField(workspace),
    h(
      "div",
      { class: "line" },
      toggle,
      button(t("showAll"), () => canvas.fit(canvas.box, 250)),
    ),
    measure.element,
    stale.element,
    h("p", {}, size),
    h("p", {}, h("small", {}, t("lookMeaning"))),
    h("p", {}, h("a", { href: `v1/maps/${map.id}?f=html`, target: "_blank", rel: "noopener" }, t("mapDocument"))),
  );
  return {
    element,
    click: (_point, features) => {
      if (!measure.isOn()) workspace.choose(features);
    },
    key: (event) => {
      if (event.key === "Escape" && measure.isOn()) toggle.click();
    },
    close: () => {
      measure.close();
      stale.close();
    },
  };
}
