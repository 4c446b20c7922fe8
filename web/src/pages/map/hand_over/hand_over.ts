/** Handing over: files for other programs, the table of locations, how well the map fits a known truth. */

import { h } from "../../../dom";
import type { OpenTool, Tool, Workspace } from "../workspace";
import { evaluation } from "./evaluation";
import { exportList } from "./export_list";
import { locationTable } from "./location_table";

export const handOver: Tool = { id: "hand-over", name: "handOver", open };

function open(workspace: Workspace): OpenTool {
  const truth = evaluation(workspace);
  return {
    element: h("div", {}, locationTable(workspace), exportList(workspace), truth.element),
    close: truth.close,
  };
}
