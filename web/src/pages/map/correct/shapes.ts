/** Corrections as they are drawn on the map. */

import Feature from "ol/Feature";
import { LineString, MultiPoint, MultiPolygon, Point as PointGeometry, Polygon, type Geometry } from "ol/geom";
import { Fill, Stroke, Style } from "ol/style";

import { pointsOf, shapeOf, type Correction } from "../../../corrections/correction";
import { placeCount, rowPlaces } from "../../../corrections/geometry";
import type { Point } from "../../../map/frame";
import { COLORS, dot, line } from "../../../map/look";

/** Places of a row that are drawn; the service counts all. */
const MOST_PLACES = 5_000;

const coordinates = (points: readonly Point[]): number[][] => points.map((point) => [...point]);
const closed = (points: readonly Point[]): number[][] => coordinates([...points, ...points.slice(0, 1)]);

/** The shape whose points a person moves. */
export function outline(correction: Correction): Geometry {
  const points = pointsOf(correction);
  switch (shapeOf(correction.kind)) {
    case "ring":
      return new Polygon([closed(points)]);
    case "line":
      return new LineString(coordinates(points));
    default:
      return new MultiPoint(coordinates(points));
  }
}

/** The features that show a correction. */
export function drawn(correction: Correction, color: string, isChosen: boolean): Feature[] {
  const shape = new Feature(outline(correction));
  shape.set("look", look(correction, color, isChosen));
  if (correction.kind !== "row") return [shape];
  const places = Math.min(placeCount(correction), Math.floor(MOST_PLACES / Math.max(1, correction.layers)));
  const rings = rowPlaces(correction.rectangle, places, correction.layers);
  const inner = new Feature(new MultiPolygon(rings.map((ring) => [closed(ring)])));
  inner.set("look", [line("#ffffff", 2.5), line(color, 1.2)]);
  return [inner, shape];
}

function look({ kind }: Correction, color: string, isChosen: boolean): Style[] {
  const width = isChosen ? 4 : 2;
  if (shapeOf(kind) === "points") return [dot(color, isChosen ? 8 : 6)];
  const border = [line("#ffffff", width + 2), line(color, width, kind === "erase" ? [6, 4] : [])];
  if (kind !== "draw" && kind !== "erase") return border;
  return [new Style({ fill: new Fill({ color: `${color}${kind === "draw" ? "44" : "22"}` }) }), ...border];
}

/** What is being drawn: the points that were set, and the way to the pointer. */
export function sketched(shape: "ring" | "line" | "points", points: readonly Point[]): Feature[] {
  const marks = points.map((point) => {
    const mark = new Feature(new PointGeometry([...point]));
    mark.set("look", [dot(COLORS.chosen, 4)]);
    return mark;
  });
  if (shape === "points" || points.length < 2) return marks;
  const way = new Feature(
    shape === "ring" && points.length > 2 ? new Polygon([closed(points)]) : new LineString(coordinates(points)),
  );
  way.set("look", [
    new Style({
      fill: new Fill({ color: `${COLORS.chosen}22` }),
      stroke: new Stroke({ color: COLORS.chosen, width: 2, lineDash: [5, 4] }),
    }),
  ]);
  return [way, ...marks];
}
