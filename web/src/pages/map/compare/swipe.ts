/** A divider over the map: at its left lies what the map is compared with, at its right the map as it is. */

import { unByKey } from "ol/Observable";
import type Layer from "ol/layer/Layer";
import type RenderEvent from "ol/render/Event";
import { getRenderPixel } from "ol/render";

import { h } from "../../../dom";
import { t } from "../../../language";
import type { MapCanvas } from "../../../map/map_canvas";

/** Where the divider is at first and how far a key moves it, percent of the width. */
const BEGIN = 50;
const STEP = 1;

export interface Sides {
  /** Layers that are seen at the left only. */
  readonly left: readonly Layer[];
  /** Layers that are seen at the right only. */
  readonly right: readonly Layer[];
  readonly leftName: string;
  readonly rightName: string;
}

/** Divides the map. Returns how to take the divider away. */
export function swipe({ map, target }: MapCanvas, { left, right, leftName, rightName }: Sides): () => void {
  const divider = h("div", { class: "divider" });
  const range = h("input", {
    type: "range",
    class: "swipe",
    min: 0,
    max: 100,
    step: STEP,
    value: BEGIN,
    "aria-label": t("swipe"),
    oninput: () => place(),
  });
  const names = h(
    "div",
    { class: "side-names" },
    h("span", { class: "card" }, `← ${leftName}`),
    h("span", { class: "card" }, `${rightName} →`),
  );
  const place = (): void => {
    divider.style.left = `${range.value}%`;
    map.render();
  };

  const width = (): number => map.getSize()?.[0] ?? 0;
  const middle = (): number => (width() * range.valueAsNumber) / 100;
  /** A layer that is drawn as an image tells of the drawing of its image, too, which is larger and stays whole. */
  const isOfMap = (event: RenderEvent): boolean => event.frameState?.size[0] === width();
  /** Draws a layer within some columns of the map only, pixels. */
  const clip = (event: RenderEvent, from: number, to: number): void => {
    if (!isOfMap(event)) return;
    const context = event.context as CanvasRenderingContext2D;
    const height = map.getSize()?.[1] ?? 0;
    const corner = (x: number, y: number): [number, number] => getRenderPixel(event, [x, y]) as [number, number];
    context.save();
    context.beginPath();
    context.moveTo(...corner(from, 0));
    context.lineTo(...corner(to, 0));
    context.lineTo(...corner(to, height));
    context.lineTo(...corner(from, height));
    context.closePath();
    context.clip();
  };
  const keys = [
    ...left.map((layer) => layer.on("prerender", (event: RenderEvent) => clip(event, 0, middle()))),
    ...right.map((layer) => layer.on("prerender", (event: RenderEvent) => clip(event, middle(), width()))),
    ...[...left, ...right].map((layer) =>
      layer.on("postrender", (event: RenderEvent) => {
        if (isOfMap(event)) (event.context as CanvasRenderingContext2D).restore();
      }),
    ),
  ];
  target.parentElement?.append(divider, range, names);
  place();
  return () => {
    unByKey(keys);
    for (const element of [divider, range, names]) element.remove();
    map.render();
  };
}
