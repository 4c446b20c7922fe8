/** Where the grid of a map lies in the map frame: metres, x to the right, y up. */

import type { Frame } from "../service/types";

export type Point = readonly [x: number, y: number];
/** Smallest x and y, largest x and y. */
export type Box = [number, number, number, number];

/** A grid: its frame, and its size in cells. */
export interface Grid {
  readonly frame: Frame;
  readonly width: number;
  readonly height: number;
}

/** A point of the picture (pixels from its upper left corner) in the map frame. */
export function ofPixel(grid: Grid, [column, row]: Point): Point {
  const { resolutionM, originM, yawRad } = grid.frame;
  const [x, y] = [column * resolutionM, (grid.height - row) * resolutionM];
  const [sine, cosine] = [Math.sin(yawRad), Math.cos(yawRad)];
  return [(originM[0] ?? 0) + x * cosine - y * sine, (originM[1] ?? 0) + x * sine + y * cosine];
}

/** The box around a grid. */
export function boxOf(grid: Grid): Box {
  const corners: Point[] = [
    [0, 0],
    [grid.width, 0],
    [0, grid.height],
    [grid.width, grid.height],
  ];
  return boxAround(corners.map((corner) => ofPixel(grid, corner)));
}

export function boxAround(points: readonly Point[]): Box {
  const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}

/** Length of a path. */
export function lengthOf(points: readonly Point[]): number {
  return points.slice(1).reduce((sum, [x, y], index) => {
    const [beforeX, beforeY] = points[index] ?? [x, y];
    return sum + Math.hypot(x - beforeX, y - beforeY);
  }, 0);
}
