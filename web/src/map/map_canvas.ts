/** The drawn map: picture, layers, what is chosen on it. Plain metres; nothing turns. */

import { defaults as defaultControls, ScaleLine } from "ol/control";
import type Feature from "ol/Feature";
import { defaults as defaultInteractions } from "ol/interaction";
import VectorLayer from "ol/layer/Vector";
import VectorImageLayer from "ol/layer/VectorImage";
import OlMap from "ol/Map";
import { Projection } from "ol/proj";
import VectorSource from "ol/source/Vector";
import View from "ol/View";

import type { Collections } from "./collections";
import { boxOf, type Box, type Grid, type Point } from "./frame";
import { LAYERS, type LayerKind, type Reading } from "./layers";
import { CHOSEN } from "./look";
import { pictureOf, rasterLayer } from "./raster";

/** How near a line or a point has to be to the pointer, pixels. */
const NEAR = 6;
/** Width of a page, pixels, on which the list of layers lies open beside the map. */
export const WIDE = 900;
/** Pixels kept free around what is shown whole; at the right lies the list of layers, where it is open. */
const PADDING = [30, 40, 40, 40];
const PADDING_BESIDE_LAYERS = [30, 250, 40, 40];
/** The closest view of a flight, metres a pixel. */
const CLOSEST_FLIGHT = 0.02;
/** Pixels of a cell at the closest look. */
const CLOSEST = 40;

export class MapCanvas {
  readonly map: OlMap;
  /** What is chosen, drawn over all else. */
  readonly chosen = new VectorSource();
  /** What is under the pointer. */
  readonly hovered = new VectorSource();
  readonly box: Box;
  readonly raster;
  /** Plain metres of the map frame. */
  readonly projection = new Projection({
    code: "map-frame",
    units: "m",
    getPointResolution: (resolution) => resolution,
  });
  private readonly layers = new Map<string, (VectorLayer | VectorImageLayer)[]>();

  constructor(
    readonly target: HTMLElement,
    grid: Grid,
    picture: string,
    private readonly collections: Collections,
    reading: Reading,
    private readonly failed: (error: unknown) => void,
  ) {
    this.box = boxOf(grid);
    const { projection } = this;
    this.raster = rasterLayer(pictureOf(grid), picture, projection);
    this.map = new OlMap({
      target,
      layers: [this.raster],
      controls: defaultControls({ attribution: false, rotate: false }).extend([new ScaleLine()]),
      interactions: defaultInteractions({ altShiftDragRotate: false, pinchRotate: false }),
      view: new View({
        projection,
        center: [(this.box[0] + this.box[2]) / 2, (this.box[1] + this.box[3]) / 2],
        resolution: 1,
        minResolution: grid.frame.resolutionM / CLOSEST,
        enableRotation: false,
      }),
    });
    LAYERS.forEach((kind, index) => this.addLayers(kind, 10 + index, reading));
    this.overlay(this.chosen, 101);
    this.overlay(this.hovered, 100);
  }

  private addLayers(kind: LayerKind, zIndex: number, reading: Reading): void {
    const layers = kind.collections.map((collection) => {
      const options = {
        source: this.collections.source(collection),
        style: (feature: Parameters<LayerKind["style"]>[0]) => kind.style(feature, reading),
        visible: false,
        zIndex,
      };
      // Texts must not overlap, which needs a new drawing for each view: only where few features are seen.
      return kind.maxResolution
        ? new VectorLayer({ ...options, maxResolution: kind.maxResolution, declutter: true })
        : new VectorImageLayer({ ...options, imageRatio: 2 });
    });
    this.layers.set(kind.id, layers);
    for (const layer of layers) this.map.addLayer(layer);
  }

  /** The layers of the map's collections, without its picture and what tools draw. */
  ownLayers(): (VectorLayer | VectorImageLayer)[] {
    return [...this.layers.values()].flat();
  }

  /** A layer of a tool, above the map's own. */
  overlay(
    source: VectorSource,
    zIndex = 50,
    style: ConstructorParameters<typeof VectorLayer>[0] = { style: CHOSEN },
  ): VectorLayer {
    const layer = new VectorLayer({ source, zIndex, ...style });
    this.map.addLayer(layer);
    return layer;
  }

  remove(layer: VectorLayer): void {
    this.map.removeLayer(layer);
  }

  /** Shows or hides a layer; its features are read when it is first shown. */
  setShown(id: string, isShown: boolean): void {
    for (const layer of this.layers.get(id) ?? []) layer.setVisible(isShown);
    const kind = LAYERS.find((layer) => layer.id === id);
    if (isShown) for (const collection of kind?.collections ?? []) this.collections.read(collection).catch(this.failed);
  }

  isShown(id: string): boolean {
    return this.layers.get(id)?.some((layer) => layer.getVisible()) ?? false;
  }

  /** Draws anew: what colours follow from has changed. */
  redraw(): void {
    for (const layer of this.ownLayers()) layer.changed();
  }

  /** The features at a point: from the uppermost shown layer to the lowest. */
  at(point: Point): Feature[] {
    const found = new Set<Feature>();
    const reach = NEAR * (this.map.getView().getResolution() ?? 1);
    for (const kind of [...LAYERS].reverse().filter(({ id }) => this.isShown(id))) {
      for (const collection of kind.collections) {
        for (const feature of featuresNear(this.collections.source(collection), point, reach)) found.add(feature);
      }
    }
    return [...found];
  }

  look(center: Point, resolution: number): void {
    this.map.getView().setCenter([...center]);
    this.map.getView().setResolution(resolution);
  }

  /** Shows a box whole, at once or by a short flight. */
  fit(box: Box, duration = 0): void {
    const padding = innerWidth > WIDE ? PADDING_BESIDE_LAYERS : PADDING;
    this.map.getView().fit(box, { padding, duration, minResolution: CLOSEST_FLIGHT });
  }
}

/** Areas around a point, and the line or dot nearest to it within reach. */
function featuresNear(source: VectorSource, point: Point, reach: number): Feature[] {
  const around = source
    .getFeaturesAtCoordinate([...point])
    .filter((feature) => feature.getGeometry()?.getType().endsWith("Polygon"));
  if (around.length > 0) return around;
  const nearest = source.getClosestFeatureToCoordinate(
    [...point],
    (feature) => !feature.getGeometry()?.getType().endsWith("Polygon"),
  );
  const at = nearest?.getGeometry()?.getClosestPoint([...point]);
  if (!nearest || !at) return [];
  return Math.hypot((at[0] ?? 0) - point[0], (at[1] ?? 0) - point[1]) <= reach ? [nearest] : [];
}
