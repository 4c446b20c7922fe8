/** One map: its picture with layers, and beside it the tool that is open. */

import "ol/ol.css";
import "../../style/map.css";
import * as address from "../../address";
import { h, replace } from "../../dom";
import { t } from "../../language";
import { Labels } from "../../labels/labels";
import { Collections } from "../../map/collections";
import { coordinatesOf } from "../../map/coordinates";
import type { Properties } from "../../map/geojson";
import { rowOf } from "../../map/geojson";
import { MapCanvas } from "../../map/map_canvas";
import { clear, problemBox, show } from "../../parts/problem";
import { onConnection } from "../../service/connection";
import { get } from "../../service/request";
import type { Diagnostics, MapView } from "../../service/types";
import type { Page } from "../page";
import { follow } from "./follow_address";
import { inspector } from "./inspector";
import { layerSwitch } from "./layer_switch";
import { pointer } from "./pointer";
import { TOOLS } from "./tools";
import type { OpenTool, Workspace } from "./workspace";

export function mapPage(id: string): Page {
  const problems = problemBox();
  const panel = h("div", { class: "panel" }, problems);
  const target = h("div", { class: "canvas", tabindex: 0, role: "application", "aria-label": t("mapCanvas") });
  const element = h("div", { class: "workspace" }, panel, h("div", { class: "view" }, target));
  const leaving: (() => void)[] = [];
  let isLeft = false;
  const begin = (): void =>
    void open(id, panel, target, problems).then(
      (leave) => {
        stopWaiting();
        if (isLeft) leave();
        else leaving.push(leave);
      },
      (error: unknown) => show(problems, error),
    );
  // What could not be opened is opened once the service is back.
  const stopWaiting = onConnection((isGone) => !isGone && begin());
  leaving.push(stopWaiting);
  begin();
  return {
    element,
    leave: () => {
      isLeft = true;
      for (const leave of leaving) leave();
    },
  };
}

async function open(id: string, panel: HTMLElement, target: HTMLElement, problems: HTMLElement): Promise<() => void> {
  // The face of an edge is looked up when something is drawn: long after its collection is there.
  const faceRow = (face: number): Properties | undefined => {
    const feature = collections.source("faces").getFeatureById(`faces/${face}`);
    return feature ? rowOf(feature as { get(name: string): unknown }) : undefined;
  };
  const [map, diagnostics, labels] = await Promise.all([
    get<MapView>(`v1/maps/${id}`),
    get<Diagnostics>(`v1/maps/${id}/diagnostics`),
    Labels.of(id, faceRow),
  ]);
  document.title = `${map.name} · stillage`;
  const coordinates = coordinatesOf(map.georeference);
  const collections = new Collections(id, coordinates);
  const failed = (error: unknown): void => show(problems, error);
  const grid = { frame: diagnostics.frame, width: map.width, height: map.height };
  const canvas = new MapCanvas(target, grid, `v1/maps/${id}/image.png`, collections, labels, failed);
  const details = inspector(id, canvas, collections, failed);
  const workspace: Workspace = {
    map,
    collections,
    coordinates,
    canvas,
    labels,
    failed,
    clearProblems: () => clear(problems),
    choose: details.choose,
  };

  let opened: OpenTool | undefined;
  const content = h("div", { class: "tool", role: "tabpanel", tabindex: -1, "aria-labelledby": "open-tab" });
  const tabs = h("div", { class: "tabs", role: "tablist", "aria-label": t("tools") });
  const layers = layerSwitch(workspace);
  replace(panel, h("h1", {}, map.name), tabs, problems, content);
  target.parentElement?.append(layers.element, details.element);

  const showTool = (wanted: string): void => {
    opened?.close();
    clear(problems);
    const tool = TOOLS.find((tool) => tool.id === wanted) ?? TOOLS[0];
    opened = tool?.open(workspace);
    replace(tabs, ...TOOLS.map((other) => tab(map.id, other.id, t(other.name), other === tool)));
    replace(content, opened?.element);
  };
  const stopPointer = pointer(workspace, () => opened);
  const stopLabels = labels.onChange(() => canvas.redraw());
  const stopAddress = follow(workspace, showTool, layers.update);
  return () => {
    opened?.close();
    stopPointer();
    stopLabels();
    stopAddress();
    canvas.map.setTarget(undefined);
  };
}

function tab(map: string, tool: string, name: string, isOpen: boolean): HTMLElement {
  const href = address.ofMap(map, tool, address.read(location.hash).view);
  return h("a", { href, role: "tab", "aria-selected": String(isOpen), id: isOpen ? "open-tab" : null }, name);
}
