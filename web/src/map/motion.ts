/** A turn about the origin of the map frame, then a shift: how one map lies on another. */

import type { Point } from "./frame";

export interface Motion {
  /** x and y, metres. */
  readonly shiftM: readonly number[];
  /** Counter-clockwise, degrees. */
  readonly turnDeg: number;
}

export function moved({ shiftM, turnDeg }: Motion, [x, y]: Point): Point {
  const [sine, cosine] = sineAndCosine(turnDeg);
  return [x * cosine - y * sine + (shiftM[0] ?? 0), x * sine + y * cosine + (shiftM[1] ?? 0)];
}

/** Where a point lay before it was moved. */
export function movedBack({ shiftM, turnDeg }: Motion, point: Point): Point {
  const [sine, cosine] = sineAndCosine(turnDeg);
  const [x, y] = [point[0] - (shiftM[0] ?? 0), point[1] - (shiftM[1] ?? 0)];
  return [x * cosine + y * sine, y * cosine - x * sine];
}

function sineAndCosine(degrees: number): [number, number] {
  const radians = (degrees * Math.PI) / 180;
  return [Math.sin(radians), Math.cos(radians)];
}
