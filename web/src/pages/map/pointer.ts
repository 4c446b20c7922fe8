/** The pointer over the map: what is under it is marked and named; a click goes to the open tool or shows what is there. */

import type MapBrowserEvent from "ol/MapBrowserEvent";

import { h, replace } from "../../dom";
import { number } from "../../language";
import type { Point } from "../../map/frame";
import { featureName } from "./feature_name";
import type { OpenTool, Workspace } from "./workspace";

export function pointer(workspace: Workspace, opened: () => OpenTool | undefined): () => void {
  const { canvas, choose } = workspace;
  const note = h("div", { class: "hover card", hidden: true });
  canvas.target.parentElement?.append(note);
  const pointOf = (event: MapBrowserEvent): Point => [event.coordinate[0] ?? 0, event.coordinate[1] ?? 0];

  const move = (event: MapBrowserEvent): void => {
    if (event.dragging) return;
    const point = pointOf(event);
    const [feature] = canvas.at(point);
    canvas.hovered.clear(true);
    if (feature) canvas.hovered.addFeature(feature.clone());
    else canvas.hovered.changed();
    note.hidden = false;
    replace(
      note,
      `${number(point[0], 2)}, ${number(point[1], 2)} m`,
      feature && h("strong", {}, ` ${featureName(feature)}`),
    );
  };
  const click = (event: MapBrowserEvent): void => {
    const point = pointOf(event);
    const features = canvas.at(point);
    const tool = opened();
    if (tool?.click) tool.click(point, features);
    else choose(features);
  };
  const key = (event: KeyboardEvent): void => {
    const isInField =
      event.target instanceof HTMLElement &&
      event.target.matches("input:not([type=checkbox]):not([type=range]), textarea, select");
    if (isInField || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Escape") choose([]);
    opened()?.key?.(event);
  };
  canvas.map.on("pointermove", move as never);
  canvas.map.on("click", click as never);
  const leave = (): void => {
    note.hidden = true;
    canvas.hovered.clear();
  };
  canvas.target.addEventListener("pointerleave", leave);
  addEventListener("keydown", key);
  return () => removeEventListener("keydown", key);
}
