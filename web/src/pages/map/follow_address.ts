/** The address holds the tool, where the map is looked at, and the layers that differ from the usual ones. */

import * as address from "../../address";
import { LAYERS } from "../../map/layers";
import type { Workspace } from "./workspace";

/** Follows the address, and writes the view into it. Returns how to stop. */
export function follow(workspace: Workspace, showTool: (tool: string) => void, layersChanged: () => void): () => void {
  const { canvas, map } = workspace;
  let shownTool = "";

  const read = (): void => {
    const { tool, view } = address.read(location.hash);
    const shown = view.get("layers")?.split(",");
    for (const kind of LAYERS) {
      const isShown = shown ? shown.includes(kind.id) : kind.isShown;
      if (isShown !== canvas.isShown(kind.id)) canvas.setShown(kind.id, isShown);
    }
    layersChanged();
    const [x, y, resolution] = ["x", "y", "r"].map((name) => Number(view.get(name) ?? Number.NaN));
    if ([x, y, resolution].every(Number.isFinite)) canvas.look([x ?? 0, y ?? 0], resolution ?? 1);
    else if (shownTool === "") canvas.fit(canvas.box);
    if (tool !== shownTool) showTool(tool);
    shownTool = tool;
  };

  const write = (): void => {
    const { map: id, tool, view } = address.read(location.hash);
    if (id !== map.id) return;
    const now = new Map(view);
    const [x = 0, y = 0] = canvas.map.getView().getCenter() ?? [];
    now
      .set("x", x.toFixed(2))
      .set("y", y.toFixed(2))
      .set("r", (canvas.map.getView().getResolution() ?? 1).toPrecision(4));
    const shown = LAYERS.filter((kind) => canvas.isShown(kind.id))
      .map((kind) => kind.id)
      .join();
    const usual = LAYERS.filter((kind) => kind.isShown)
      .map((kind) => kind.id)
      .join();
    if (shown === usual) now.delete("layers");
    else now.set("layers", shown);
    history.replaceState(null, "", address.ofMap(id, tool, now));
    for (const tab of document.querySelectorAll<HTMLAnchorElement>(".tabs a")) {
      tab.href = address.ofMap(id, address.read(tab.hash).tool, now);
    }
  };

  const changed = (): void => {
    read();
    // An address without a view names a tool alone: the view stays.
    write();
  };
  addEventListener("hashchange", changed);
  canvas.map.on("moveend", write);
  canvas.target.addEventListener("layerschanged", write);
  read();
  return () => removeEventListener("hashchange", changed);
}
