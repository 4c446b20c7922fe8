/**
 * Between the map frame and the coordinates in which the service answers.
 *
 * A map without georeference answers in its own metres under the name EPSG:3857. One with a georeference answers in
 * degrees on the tangent plane at the map's origin, by the formulas of the service (`coordinates::transform`).
 */

import type { Georeference } from "../service/types";
import type { Point } from "./frame";

/** Radius of the equator in WGS 84, metres. */
const RADIUS = 6_378_137;
/** Flattening of WGS 84. */
const FLATTENING = 1 / 298.257_223_563;

export interface Coordinates {
  /** The value of the parameter `crs`. */
  readonly crs: string;
  /** Answer to map frame. */
  toMap(position: Point): Point;
  /** Map frame to request. */
  ofMap(point: Point): Point;
}

export function coordinatesOf(georeference: Georeference): Coordinates {
  return georeference.status === "nominal" ? METRES : tangentPlane(georeference);
}

const METRES: Coordinates = { crs: "EPSG:3857", toMap: (position) => position, ofMap: (point) => point };

function tangentPlane({ lon = 0, lat = 0, heading = 0 }: Georeference): Coordinates {
  const radians = Math.PI / 180;
  const eccentricity = FLATTENING * (2 - FLATTENING);
  const flat = 1 - eccentricity * Math.sin(lat * radians) ** 2;
  const eastwards = Math.max((RADIUS / Math.sqrt(flat)) * Math.cos(lat * radians), 1) * radians;
  const northwards = ((RADIUS * (1 - eccentricity)) / flat ** 1.5) * radians;
  const [sine, cosine] = [Math.sin(heading * radians), Math.cos(heading * radians)];
  return {
    crs: "CRS84",
    toMap: ([x, y]) => {
      const [east, north] = [(x - lon) * eastwards, (y - lat) * northwards];
      return [east * cosine - north * sine, east * sine + north * cosine];
    },
    ofMap: ([x, y]) => [lon + (x * cosine + y * sine) / eastwards, lat + (y * cosine - x * sine) / northwards],
  };
}
