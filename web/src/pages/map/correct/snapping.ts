/** Snapping on a map: what lies around the pointer, and the dominant directions. */

import type Feature from "ol/Feature";
import type { Geometry, LineString, MultiLineString, MultiPolygon, Polygon } from "ol/geom";

import type { Wanted } from "../../../corrections/draft";
import { pointsOf, shapeOf } from "../../../corrections/correction";
import { withRightAngles } from "../../../corrections/geometry";
import { snapped, type Snapped } from "../../../corrections/snap";
import type { Point } from "../../../map/frame";
import type { Workspace } from "../workspace";

/** Pixels within which a point is drawn to something. */
const REACH = 9;
/** What lies on walls, racks and borders. */
const SNAPPED = ["edges", "lines", "faces"];

export interface Snapping {
  isOn: boolean;
  /** Directions of the map and those across them, radians. */
  readonly directions: readonly number[];
  /** Where a point is meant to be; `previous` is the corner drawn before it. */
  place(point: Point, previous?: Point): Snapped;
}

export function snapping(
  { collections, canvas, failed }: Workspace,
  angles: readonly number[],
  wanted: () => readonly Wanted[],
): Snapping {
  const directions = withRightAngles(angles);
  for (const collection of SNAPPED) collections.read(collection).catch(failed);

  function around([x, y]: Point, reach: number): Point[][] {
    const box = [x - reach, y - reach, x + reach, y + reach];
    const drawn = SNAPPED.flatMap((collection) => collections.source(collection).getFeaturesInExtent(box));
    const own = wanted().map(({ correction }): Point[] => {
      const points = [...pointsOf(correction)];
      const [first] = points;
      return shapeOf(correction.kind) === "ring" && first ? [...points, first] : points;
    });
    return [...drawn.flatMap(paths), ...own];
  }

  return {
    isOn: true,
    directions,
    place(point, previous) {
      if (!this.isOn) return { point, to: undefined };
      const reach = REACH * (canvas.map.getView().getResolution() ?? 1);
      const ways = around(point, reach);
      const edges = ways.flatMap((way) => way.slice(1).map((to, index) => [way[index] ?? to, to] as const));
      return snapped(point, previous, { corners: ways.flat(), edges, directions }, reach);
    },
  };
}

/** The lines and rings of a feature. */
function paths(feature: Feature): Point[][] {
  const geometry: Geometry | undefined = feature.getGeometry();
  const coordinates = (): unknown => (geometry as Polygon).getCoordinates();
  switch (geometry?.getType()) {
    case "LineString":
      return [(geometry as LineString).getCoordinates() as unknown as Point[]];
    case "MultiLineString":
      return (geometry as MultiLineString).getCoordinates() as unknown as Point[][];
    case "Polygon":
      return coordinates() as Point[][];
    case "MultiPolygon":
      return ((geometry as MultiPolygon).getCoordinates() as unknown as Point[][][]).flat();
    default:
      return [];
  }
}
