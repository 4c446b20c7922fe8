/** Rectangles, the places of a row, and points that follow directions. Angles are radians in the map frame. */

import type { Point } from "../map/frame";

/** How far a side may lie from a direction to be turned into it, radians (20 degrees). */
const TURN = Math.PI / 9;

/** A rectangle by two opposite corners, its first side along a direction. */
export function rectangleOf(corner: Point, opposite: Point, direction: number): Point[] {
  const along: Point = [Math.cos(direction), Math.sin(direction)];
  const diagonal: Point = [opposite[0] - corner[0], opposite[1] - corner[1]];
  const length = diagonal[0] * along[0] + diagonal[1] * along[1];
  const second: Point = [corner[0] + length * along[0], corner[1] + length * along[1]];
  const fourth: Point = [corner[0] + opposite[0] - second[0], corner[1] + opposite[1] - second[1]];
  return [corner, second, opposite, fourth];
}

/** The same rectangle, its first side the longer one. */
export function alongLongSide(rectangle: readonly Point[]): Point[] {
  const [a, b, c, d] = rectangle as [Point, Point, Point, Point];
  return distance(a, b) >= distance(b, c) ? [a, b, c, d] : [b, c, d, a];
}

/** The same rectangle, its rows along the other side. */
export function turned(rectangle: readonly Point[]): Point[] {
  return [...rectangle.slice(1), ...rectangle.slice(0, 1)];
}

/** A rectangle of which one corner was moved: the opposite one stays, and so do the directions. */
export function withCorner(rectangle: readonly Point[], index: number, to: Point): Point[] {
  const [first, second] = [rectangle[0] ?? to, rectangle[1] ?? to];
  const direction = Math.atan2(second[1] - first[1], second[0] - first[0]);
  const opposite = rectangle[(index + 2) % 4] ?? to;
  // An even corner and the one after it lie on one side along the row; an odd one ends such a side.
  const around = rectangleOf(to, opposite, index % 2 === 0 ? direction : direction + Math.PI / 2);
  return [0, 1, 2, 3].map((corner) => around[(corner - index + 4) % 4] ?? to);
}

export function distance([x, y]: Point, [otherX, otherY]: Point): number {
  return Math.hypot(otherX - x, otherY - y);
}

/** How many places a row has: those asked for, else as many as its pitch allows. */
export function placeCount(row: {
  readonly rectangle: readonly Point[];
  readonly places?: number;
  readonly pitchM?: number;
}): number {
  if (row.places !== undefined) return row.places;
  const [first, second] = row.rectangle;
  const length = first && second ? distance(first, second) : 0;
  return Math.max(1, Math.round(length / (row.pitchM ?? length)));
}

/** The places of a row: rings of four corners, along the row and one layer behind the other. */
export function rowPlaces(rectangle: readonly Point[], places: number, layers: number): Point[][] {
  const [a, b, c, d] = rectangle as [Point, Point, Point, Point];
  const between = (from: Point, to: Point, share: number): Point => [
    from[0] + (to[0] - from[0]) * share,
    from[1] + (to[1] - from[1]) * share,
  ];
  const at = (along: number, across: number): Point => between(between(a, b, along), between(d, c, along), across);
  return Array.from({ length: places * layers }, (_, index) => {
    const [place, layer] = [index % places, Math.floor(index / places)];
    const [left, right] = [place / places, (place + 1) / places];
    const [front, back] = [layer / layers, (layer + 1) / layers];
    return [at(left, front), at(right, front), at(right, back), at(left, back)];
  });
}

/** Directions that are nearer to one another than this are one, radians (a tenth of a degree). */
const SAME_DIRECTION = Math.PI / 1800;

/** Directions and those across them, in half a turn. */
export function withRightAngles(directions: readonly number[]): number[] {
  const half = (angle: number): number => ((angle % Math.PI) + Math.PI) % Math.PI;
  const found: number[] = [];
  for (const angle of directions.flatMap((along) => [half(along), half(along + Math.PI / 2)])) {
    if ((nearestDirection(angle, found)?.turn ?? Math.PI) > SAME_DIRECTION) found.push(angle);
  }
  return found;
}

/** The direction nearest to an angle, and how far it is. */
export function nearestDirection(
  angle: number,
  directions: readonly number[],
): { readonly direction: number; readonly turn: number } | undefined {
  let best: { direction: number; turn: number } | undefined;
  for (const direction of directions) {
    const apart = (((angle - direction) % Math.PI) + Math.PI) % Math.PI;
    const turn = Math.min(apart, Math.PI - apart);
    if (!best || turn < best.turn) best = { direction, turn };
  }
  return best;
}

/** A ring or a line whose sides lie along directions: each side is turned about its middle. */
export function aligned(points: readonly Point[], isRing: boolean, directions: readonly number[]): Point[] {
  const count = isRing ? points.length : points.length - 1;
  const sides = Array.from({ length: count }, (_, index) => {
    const [from, to] = [points[index], points[(index + 1) % points.length]] as [Point, Point];
    const angle = Math.atan2(to[1] - from[1], to[0] - from[0]);
    const nearest = nearestDirection(angle, directions);
    const middle: Point = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
    return { middle, angle: nearest && nearest.turn <= TURN ? nearest.direction : angle };
  });
  return points.map((point, index) => {
    const before = isRing ? sides[(index + count - 1) % count] : sides[index - 1];
    const after = sides[index];
    if (before && after) return crossing(before, after) ?? footOn(after, point);
    const side = before ?? after;
    return side ? footOn(side, point) : point;
  });
}

interface Side {
  readonly middle: Point;
  readonly angle: number;
}

/** Where two lines cross; nothing where they are parallel. */
function crossing(one: Side, other: Side): Point | undefined {
  const [a, b] = [unit(one.angle), unit(other.angle)];
  const cross = a[0] * b[1] - a[1] * b[0];
  if (Math.abs(cross) < 1e-6) return undefined;
  const [x, y] = [other.middle[0] - one.middle[0], other.middle[1] - one.middle[1]];
  const along = (x * b[1] - y * b[0]) / cross;
  return [one.middle[0] + along * a[0], one.middle[1] + along * a[1]];
}

function footOn({ middle, angle }: Side, point: Point): Point {
  const [x, y] = unit(angle);
  const along = (point[0] - middle[0]) * x + (point[1] - middle[1]) * y;
  return [middle[0] + along * x, middle[1] + along * y];
}

function unit(angle: number): Point {
  return [Math.cos(angle), Math.sin(angle)];
}

/** Whether sides of a ring cross one another. */
export function crossesItself(ring: readonly Point[]): boolean {
  const side = (index: number): [Point, Point] => [ring[index], ring[(index + 1) % ring.length]] as [Point, Point];
  for (let one = 0; one < ring.length; one += 1) {
    for (let other = one + 2; other < ring.length; other += 1) {
      if ((other + 1) % ring.length !== one && cross(side(one), side(other))) return true;
    }
  }
  return false;
}

function cross([a, b]: [Point, Point], [c, d]: [Point, Point]): boolean {
  const turn = (from: Point, to: Point, point: Point): number =>
    (to[0] - from[0]) * (point[1] - from[1]) - (to[1] - from[1]) * (point[0] - from[0]);
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}
