/** The request for a route. */

import type { Coordinates } from "../../../map/coordinates";
import type { Point } from "../../../map/frame";

/** An end of a route as a person reads it: `12.05,-7.35` in metres of the map, or `location:CODE` and its like. */
export type End = string;

const METRES = /^\s*(-?\d+(?:\.\d+)?)\s*[,;]\s*(-?\d+(?:\.\d+)?)\s*$/;

export function endAt([x, y]: Point): End {
  return `${x.toFixed(2)},${y.toFixed(2)}`;
}

/** The point that an end names by its metres. */
export function pointOf(end: End): Point | undefined {
  const found = METRES.exec(end);
  return found ? [Number(found[1]), Number(found[2])] : undefined;
}

/** The query of the request: metres become the coordinates of the service, a bare code names a location. */
export function routeQuery(from: End, to: End, radiusM: number, profile: string, coordinates: Coordinates): string {
  const end = (text: End): string => {
    const point = pointOf(text);
    if (point) return coordinates.ofMap(point).join(",");
    return text.includes(":") ? text.trim() : `location:${text.trim()}`;
  };
  const query = new URLSearchParams({
    from: end(from),
    to: end(to),
    crs: coordinates.crs,
    footprintRadiusM: String(radiusM),
    profile,
  });
  return query.toString();
}
