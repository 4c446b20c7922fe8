/** What can be drawn, how many points it takes, and what it becomes. */

import type { Correction, Kind } from "../../../corrections/correction";
import { alongLongSide, rectangleOf } from "../../../corrections/geometry";
import type { Point } from "../../../map/frame";

/** What the form of a new correction begins with: what was chosen last. */
export interface Settings {
  readonly label: string;
  /** Distance from place to place, metres. */
  readonly pitchM: number;
  readonly layers: number;
  readonly isOpen: boolean;
  /** Direction of rectangles, radians. */
  readonly direction: number;
}

export interface Mode {
  readonly id: Exclude<Kind, "draw"> | "polygon" | "rectangle";
  /** The key that begins it. */
  readonly key: string;
  /** Points that it takes at least, and with which it ends by itself. */
  readonly least: number;
  readonly most: number;
  readonly shape: "ring" | "rectangle" | "line" | "points";
  make(points: readonly Point[], settings: Settings): Correction;
}

const pair = (points: readonly Point[]): [Point, Point] => [points[0] ?? [0, 0], points[1] ?? [0, 0]];
const rectangle = (points: readonly Point[], { direction }: Settings): Point[] =>
  rectangleOf(...pair(points), direction);
const MANY = Number.POSITIVE_INFINITY;

export const MODES: readonly Mode[] = [
  {
    id: "rectangle",
    key: "r",
    least: 2,
    most: 2,
    shape: "rectangle",
    make: (points, settings) => ({ kind: "draw", ring: rectangle(points, settings), label: settings.label }),
  },
  {
    id: "polygon",
    key: "p",
    least: 3,
    most: MANY,
    shape: "ring",
    make: (points, { label }) => ({ kind: "draw", ring: points, label }),
  },
  {
    id: "row",
    key: "w",
    least: 2,
    most: 2,
    shape: "rectangle",
    make: (points, settings) => ({
      kind: "row",
      rectangle: alongLongSide(rectangle(points, settings)),
      pitchM: settings.pitchM,
      layers: settings.layers,
      label: settings.label,
    }),
  },
  { id: "split", key: "s", least: 2, most: MANY, shape: "line", make: (line) => ({ kind: "split", line }) },
  { id: "merge", key: "m", least: 2, most: MANY, shape: "points", make: (at) => ({ kind: "merge", at }) },
  { id: "erase", key: "e", least: 3, most: MANY, shape: "ring", make: (ring) => ({ kind: "erase", ring }) },
  {
    id: "label",
    key: "l",
    least: 1,
    most: 1,
    shape: "points",
    make: (points, { label }) => ({ kind: "label", at: points[0] ?? [0, 0], label }),
  },
  {
    id: "door",
    key: "d",
    least: 2,
    most: 2,
    shape: "line",
    make: (line, { isOpen }) => ({ kind: "door", line, isOpen }),
  },
  {
    id: "name",
    key: "n",
    least: 1,
    most: 1,
    shape: "points",
    make: (points) => ({ kind: "name", at: points[0] ?? [0, 0], name: "" }),
  },
];
