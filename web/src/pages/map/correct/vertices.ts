/** The points of the chosen correction are moved on the map; what is moved is drawn to corners, edges and directions. */

import Collection from "ol/Collection";
import Feature from "ol/Feature";
import type { LineString, MultiPoint, Polygon } from "ol/geom";
import Modify from "ol/interaction/Modify";

import { pointsOf, shapeOf, withPoints, type Correction } from "../../../corrections/correction";
import { distance, withCorner } from "../../../corrections/geometry";
import type { Point } from "../../../map/frame";
import type { MapCanvas } from "../../../map/map_canvas";
import { outline } from "./shapes";
import type { Snapping } from "./snapping";

export interface VertexEditor {
  /** Lets a person move the points of a correction, or of none. */
  edit(correction: Correction | undefined): void;
  close(): void;
}

export function vertexEditor(
  { map }: MapCanvas,
  snap: Snapping,
  moved: (correction: Correction) => void,
): VertexEditor {
  let edited: Correction | undefined;
  const features = new Collection<Feature>();
  const modify = new Modify({
    features,
    // Corners come and go where a shape has any number of them.
    insertVertexCondition: () => edited?.kind === "draw" || edited?.kind === "erase" || edited?.kind === "split",
  });
  modify.on("modifyend", () => {
    const shape = features.item(0)?.getGeometry();
    if (!edited || !shape) return;
    const now = readPoints(edited, shape as Polygon | LineString | MultiPoint);
    moved(withMoved(edited, now, snap));
  });
  map.addInteraction(modify);
  return {
    edit: (correction) => {
      edited = correction;
      features.clear();
      if (correction) features.push(new Feature(outline(correction)));
    },
    close: () => void map.removeInteraction(modify),
  };
}

function readPoints({ kind }: Correction, geometry: Polygon | LineString | MultiPoint): Point[] {
  const coordinates = geometry.getCoordinates() as unknown;
  if (shapeOf(kind) !== "ring") return coordinates as Point[];
  return ((coordinates as Point[][])[0] ?? []).slice(0, -1);
}

/** The correction with the points that a person moved, each where it is meant to be. */
function withMoved(correction: Correction, now: readonly Point[], snap: Snapping): Correction {
  const before = pointsOf(correction);
  const isKept = (point: Point): boolean => before.some((old) => distance(old, point) < 1e-9);
  const placed = now.map((point) =>
    isKept(point) || shapeOf(correction.kind) === "points" ? point : snap.place(point).point,
  );
  if (correction.kind !== "row") return withPoints(correction, placed);
  const corner = now.findIndex((point) => !isKept(point));
  const to = placed[corner];
  return to ? withPoints(correction, withCorner(before, corner, to)) : correction;
}
