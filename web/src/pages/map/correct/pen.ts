/** The pen: sets points by click, by dragging a rectangle, or by keys at a crosshair, and ends what is drawn. */

import { DoubleClickZoom, DragPan } from "ol/interaction";
import type MapBrowserEvent from "ol/MapBrowserEvent";
import VectorSource from "ol/source/Vector";
import type Style from "ol/style/Style";

import { h } from "../../../dom";
import { rectangleOf, distance } from "../../../corrections/geometry";
import type { Point } from "../../../map/frame";
import type { MapCanvas } from "../../../map/map_canvas";
import type { Mode } from "./modes";
import { sketched } from "./shapes";
import type { Snapping } from "./snapping";

/** Pixels that a key moves the crosshair; with Shift it moves by one. */
const STEP = 12;
/** Pixels within which a click meets a point that was set. */
const SAME = 8;

export interface Pen {
  /** Begins to draw something, or nothing. */
  take(mode: Mode | undefined): void;
  mode(): Mode | undefined;
  /** How many points are set. */
  count(): number;
  click(point: Point): void;
  /** Answers a key while something is drawn; tells whether it was meant for the pen. */
  key(event: KeyboardEvent): boolean;
  close(): void;
}

export interface PenEvents {
  /** Direction of rectangles, radians. */
  direction(): number;
  /** All points are set. */
  done(mode: Mode, points: readonly Point[]): void;
  /** A point was set or taken back, or another thing is drawn. */
  changed(): void;
}

export function pen(canvas: MapCanvas, snap: Snapping, events: PenEvents): Pen {
  const { map, target } = canvas;
  const source = new VectorSource();
  const layer = canvas.overlay(source, 95, { style: (feature) => feature.get("look") as Style[] });
  const cross = h("div", { class: "crosshair", hidden: true, "aria-hidden": "true" });
  target.parentElement?.append(cross);
  let mode: Mode | undefined;
  let points: Point[] = [];
  let pointer: Point | undefined;
  let dragBegin: Point | undefined;

  const reach = (): number => SAME * (map.getView().getResolution() ?? 1);
  const pointOf = (event: MapBrowserEvent): Point => [event.coordinate[0] ?? 0, event.coordinate[1] ?? 0];
  const place = (point: Point): Point =>
    // What is meant by a point inside a face is the face: nothing draws it to a border.
    mode?.shape === "points" ? point : snap.place(point, mode?.shape === "rectangle" ? undefined : points.at(-1)).point;

  function draw(): void {
    source.clear();
    if (!mode) return;
    const all = pointer ? [...points, place(pointer)] : points;
    const [first, second] = all;
    if (mode.shape !== "rectangle") source.addFeatures(sketched(mode.shape, all));
    else source.addFeatures(sketched("ring", first && second ? rectangleOf(first, second, events.direction()) : all));
  }

  function set(point: Point): void {
    if (!mode) return;
    points.push(place(point));
    if (points.length >= mode.most) return finish();
    draw();
    events.changed();
  }

  function finish(): void {
    if (!mode || points.length < mode.least) return;
    const [ended, all] = [mode, points];
    points = [];
    pointer = undefined;
    draw();
    events.done(ended, all);
  }

  function click(point: Point): void {
    const [first, last] = [points[0], points.at(-1)];
    const isAt = (other: Point | undefined): boolean => other !== undefined && distance(point, other) <= reach();
    // A double click ends a line, a click on the first corner closes a ring.
    if (mode && points.length >= mode.least && (isAt(last) || (mode.shape === "ring" && isAt(first)))) finish();
    else if (!isAt(last)) set(point);
  }

  /** The place of the crosshair on the map. */
  function crossAt(): Point | undefined {
    const at = cross.hidden ? undefined : map.getCoordinateFromPixel([cross.offsetLeft, cross.offsetTop]);
    return at && [at[0] ?? 0, at[1] ?? 0];
  }

  function moveCross(x: number, y: number): void {
    const [width = 0, height = 0] = map.getSize() ?? [];
    if (cross.hidden) {
      cross.hidden = false;
      [cross.style.left, cross.style.top] = [`${Math.round(width / 2)}px`, `${Math.round(height / 2)}px`];
    }
    const within = (value: number, most: number): number => Math.min(most, Math.max(0, value));
    const [left, top] = [cross.offsetLeft + x, cross.offsetTop + y];
    [cross.style.left, cross.style.top] = [`${within(left, width)}px`, `${within(top, height)}px`];
    // At the border of the view the map moves below the crosshair.
    const resolution = map.getView().getResolution() ?? 1;
    const [beyondX, beyondY] = [left - within(left, width), top - within(top, height)];
    const [centerX = 0, centerY = 0] = map.getView().getCenter() ?? [];
    if (beyondX !== 0 || beyondY !== 0)
      map.getView().setCenter([centerX + beyondX * resolution, centerY - beyondY * resolution]);
    pointer = crossAt();
    draw();
  }

  const ARROWS: Readonly<Record<string, readonly [number, number]>> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, -1],
    ArrowDown: [0, 1],
  };

  /** Keys that the focused map would take for itself. */
  const onMap = (event: KeyboardEvent): void => {
    const arrow = ARROWS[event.key];
    if (!mode || event.ctrlKey || event.metaKey) return;
    if (arrow) {
      const step = event.shiftKey ? 1 : STEP;
      moveCross(arrow[0] * step, arrow[1] * step);
    } else if (event.key === " ") {
      if (cross.hidden) moveCross(0, 0);
      const point = crossAt();
      if (point) set(point);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  };

  const move = (event: MapBrowserEvent): void => {
    if (!mode || event.dragging) return;
    cross.hidden = true;
    pointer = pointOf(event);
    draw();
  };
  const drag = (event: MapBrowserEvent): void => {
    if (mode?.shape !== "rectangle") return;
    if (!dragBegin && points.length === 0) {
      dragBegin = pressed;
      if (dragBegin) set(dragBegin);
    }
    pointer = pointOf(event);
    draw();
  };
  let pressed: Point | undefined;
  const press = (event: MapBrowserEvent): void => {
    pressed = pointOf(event);
    dragBegin = undefined;
  };
  const release = (event: MapBrowserEvent): void => {
    if (dragBegin && mode?.shape === "rectangle" && distance(dragBegin, pointOf(event)) > reach()) set(pointOf(event));
    dragBegin = undefined;
  };
  const listeners = [
    ["pointermove", move],
    ["pointerdrag", drag],
    ["pointerdown", press],
    ["pointerup", release],
  ] as const;
  for (const [name, listener] of listeners) map.on(name as never, listener as never);
  target.addEventListener("keydown", onMap, { capture: true });

  function setActive(): void {
    for (const interaction of map.getInteractions().getArray()) {
      if (interaction instanceof DoubleClickZoom) interaction.setActive(!mode);
      if (interaction instanceof DragPan) interaction.setActive(mode?.shape !== "rectangle");
    }
  }

  function take(wanted: Mode | undefined): void {
    mode = wanted;
    [points, pointer] = [[], undefined];
    cross.hidden = true;
    setActive();
    draw();
    events.changed();
  }

  return {
    take,
    mode: () => mode,
    count: () => points.length,
    click,
    key: (event) => {
      if (!mode) return false;
      if (event.key === "Enter") finish();
      else if (event.key === "Backspace" && points.length > 0) {
        points.pop();
        draw();
        events.changed();
      } else if (event.key === "Escape") {
        if (points.length === 0) take(undefined);
        else take(mode);
      } else return false;
      return true;
    },
    close: () => {
      mode = undefined;
      setActive();
      for (const [name, listener] of listeners) map.un(name as never, listener as never);
      target.removeEventListener("keydown", onMap, { capture: true });
      cross.remove();
      canvas.remove(layer);
    },
  };
}
