/** Routes: from where to where, how wide the vehicle is, the way and its instructions; what the graph has to tell. */

import { h } from "../../../dom";
import type { OpenTool, Tool, Workspace } from "../workspace";
import { graphReport } from "./graph_report";
import { routeForm } from "./route_form";

export const routes: Tool = { id: "routes", name: "routes", open };

function open(workspace: Workspace): OpenTool {
  const form = routeForm(workspace);
  const report = graphReport(workspace);
  return {
    element: h("div", {}, form.element, report.element),
    click: form.click,
    close: () => {
      form.close();
      report.close();
    },
  };
}
