/** Where a point is meant to be: at a corner, on an edge or a wall, along a dominant direction. */

import type { Point } from "../map/frame";
import { distance, nearestDirection } from "./geometry";

/** How far a side may lie from a dominant direction to follow it, radians (6 degrees). */
const TURN = Math.PI / 30;

/** What a point may be drawn to. */
export interface Targets {
  readonly corners: readonly Point[];
  readonly edges: readonly (readonly [Point, Point])[];
  /** Dominant directions and those across them, radians. */
  readonly directions: readonly number[];
}

export interface Snapped {
  readonly point: Point;
  /** What it was drawn to. */
  readonly to: "corner" | "edge" | "direction" | undefined;
}

/**
 * The place that is meant by a point, within reach (metres); `previous` is the corner drawn before it. The two are never drawn
 * to one place: what is smaller than the reach keeps its corners.
 */
export function snapped(point: Point, previous: Point | undefined, targets: Targets, reach: number): Snapped {
  const found = meant(point, previous, targets, reach);
  return previous && distance(found.point, previous) === 0 ? { point, to: undefined } : found;
}

function meant(point: Point, previous: Point | undefined, targets: Targets, reach: number): Snapped {
  const corner = nearest(targets.corners, point, reach);
  if (corner) return { point: corner, to: "corner" };
  const along = previous && alongDirection(point, previous, targets.directions);
  const feet = targets.edges.map(([from, to]) => footOnEdge(point, from, to));
  if (along) {
    // Both at once: where the direction meets an edge.
    const crossings = targets.edges.flatMap(([from, to]) => meeting(previous, along, from, to));
    const crossing = nearest(crossings, point, reach);
    if (crossing) return { point: crossing, to: "edge" };
  }
  const foot = nearest(feet, point, reach);
  if (foot) return { point: foot, to: "edge" };
  return along && distance(along, point) <= reach * 2 ? { point: along, to: "direction" } : { point, to: undefined };
}

function nearest(points: readonly Point[], point: Point, reach: number): Point | undefined {
  let best: Point | undefined;
  for (const candidate of points) {
    const apart = distance(candidate, point);
    if (apart <= reach && (!best || apart < distance(best, point))) best = candidate;
  }
  return best;
}

/** The nearest point on the way from the corner before along the nearest direction, where it lies near enough. */
function alongDirection(point: Point, previous: Point, directions: readonly number[]): Point | undefined {
  const [x, y] = [point[0] - previous[0], point[1] - previous[1]];
  if (x === 0 && y === 0) return undefined;
  const found = nearestDirection(Math.atan2(y, x), directions);
  if (!found || found.turn > TURN) return undefined;
  const [cosine, sine] = [Math.cos(found.direction), Math.sin(found.direction)];
  const length = x * cosine + y * sine;
  return [previous[0] + length * cosine, previous[1] + length * sine];
}

function footOnEdge(point: Point, from: Point, to: Point): Point {
  const [x, y] = [to[0] - from[0], to[1] - from[1]];
  const square = x * x + y * y;
  const share = square === 0 ? 0 : ((point[0] - from[0]) * x + (point[1] - from[1]) * y) / square;
  const within = Math.min(1, Math.max(0, share));
  return [from[0] + within * x, from[1] + within * y];
}

/** Where the line through two points meets an edge. */
function meeting(start: Point, through: Point, from: Point, to: Point): Point[] {
  const [a, b] = [
    [through[0] - start[0], through[1] - start[1]],
    [to[0] - from[0], to[1] - from[1]],
  ] as [Point, Point];
  const cross = a[0] * b[1] - a[1] * b[0];
  if (Math.abs(cross) < 1e-9) return [];
  const share = ((from[0] - start[0]) * a[1] - (from[1] - start[1]) * a[0]) / cross;
  return share >= 0 && share <= 1 ? [[from[0] + share * b[0], from[1] + share * b[1]]] : [];
}
