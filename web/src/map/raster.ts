/** The picture of the map, drawn where its cells lie: shifted and turned into the map frame. */

import ImageLayer from "ol/layer/Image";
import type { Projection } from "ol/proj";
import ImageCanvasSource from "ol/source/ImageCanvas";

import { ofPixel, type Grid } from "./frame";

/** Screen pixels of a cell from which on cells are shown as squares instead of being smoothed. */
const SQUARES_FROM = 1.5;

export function rasterLayer(grid: Grid, path: string, projection: Projection): ImageLayer<ImageCanvasSource> {
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
      const place = ([x, y]: readonly [number, number]): [number, number] => [
        (x - (extent[0] ?? 0)) * scale,
        ((extent[3] ?? 0) - y) * scale,
      ];
      const corner = place(ofPixel(grid, [0, 0]));
      const right = place(ofPixel(grid, [1, 0]));
      const down = place(ofPixel(grid, [0, 1]));
      context.setTransform(
        right[0] - corner[0],
        right[1] - corner[1],
        down[0] - corner[0],
        down[1] - corner[1],
        corner[0],
        corner[1],
      );
      context.imageSmoothingEnabled = grid.frame.resolutionM * scale < SQUARES_FROM;
      context.drawImage(picture, 0, 0, grid.width, grid.height);
      context.setTransform(1, 0, 0, 1, 0, 0);
      return canvas;
    },
  });
  picture.addEventListener("load", () => source.changed());
  picture.src = path;
  return new ImageLayer({ source, zIndex: 0 });
}
