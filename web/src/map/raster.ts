/** The picture of the map, drawn where its cells lie: shifted and turned into the map frame. */

import ImageLayer from "ol/layer/Image";
import type { Projection } from "ol/proj";
import ImageCanvasSource from "ol/source/ImageCanvas";

import { ofPixel, type Grid, type Point } from "./frame";

/** Screen pixels of a cell from which on cells are shown as squares instead of being smoothed. */
const SQUARES_FROM = 1.5;

/** A picture and where it is drawn. */
export interface PlacedPicture {
  /** Columns and rows. */
  readonly width: number;
  readonly height: number;
  /** Side of a cell, metres. */
  readonly cellM: number;
  /** A point of the picture (pixels from its upper left corner) in the map frame. */
  place(pixel: Point): Point;
}

/** The picture of a grid where the grid lies. */
export function pictureOf(grid: Grid): PlacedPicture {
  const { width, height, frame } = grid;
  return { width, height, cellM: frame.resolutionM, place: (pixel) => ofPixel(grid, pixel) };
}

export function rasterLayer(
  placed: PlacedPicture,
  path: string,
  projection: Projection,
): ImageLayer<ImageCanvasSource> {
  const picture = new Image();
  const canvas = document.createElement("canvas");
  const source = new ImageCanvasSource({
    projection,
    ratio: 1.5,
    canvasFunction: (extent, resolution, pixelRatio, size) => {
      [canvas.width, canvas.height] = [Math.round(size[0] ?? 1), Math.round(size[1] ?? 1)];
      const context = canvas.getContext("2d");
      if (!context || !picture.complete || picture.naturalWidth === 0) return canvas;
      const scale = pixelRatio / resolution;
      const onCanvas = ([x, y]: readonly [number, number]): [number, number] => [
        (x - (extent[0] ?? 0)) * scale,
        ((extent[3] ?? 0) - y) * scale,
      ];
      const corner = onCanvas(placed.place([0, 0]));
      const right = onCanvas(placed.place([1, 0]));
      const down = onCanvas(placed.place([0, 1]));
      context.setTransform(
        right[0] - corner[0],
        right[1] - corner[1],
        down[0] - corner[0],
        down[1] - corner[1],
        corner[0],
        corner[1],
      );
      context.imageSmoothingEnabled = placed.cellM * scale < SQUARES_FROM;
      context.drawImage(picture, 0, 0, placed.width, placed.height);
      context.setTransform(1, 0, 0, 1, 0, 0);
      return canvas;
    },
  });
  picture.addEventListener("load", () => source.changed());
  picture.src = path;
  return new ImageLayer({ source, zIndex: 0 });
}
