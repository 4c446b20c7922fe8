/** GeoJSON of the service to features in the map frame. */

import Feature from "ol/Feature";
import { LineString, MultiLineString, MultiPolygon, Point, Polygon, type Geometry } from "ol/geom";

import type { Point as Position } from "./frame";

export type Properties = Readonly<Record<string, unknown>>;

export interface GeoJsonFeature {
  readonly id?: string | number;
  readonly geometry: { readonly type: string; readonly coordinates: never } | null;
  readonly properties: Properties | null;
}

type Change = (position: Position) => Position;

/** A geometry with every position changed; `null` for a kind that the service does not write. */
export function geometryOf(geometry: GeoJsonFeature["geometry"], change: Change): Geometry | null {
  if (geometry === null) return null;
  const coordinates = changed(geometry.coordinates, change) as never;
  switch (geometry.type) {
    case "Point":
      return new Point(coordinates);
    case "LineString":
      return new LineString(coordinates);
    case "MultiLineString":
      return new MultiLineString(coordinates);
    case "Polygon":
      return new Polygon(coordinates);
    case "MultiPolygon":
      return new MultiPolygon(coordinates);
    default:
      return null;
  }
}

function changed(coordinates: unknown, change: Change): unknown {
  const list = coordinates as unknown[];
  return typeof list[0] === "number" ? change(list as unknown as Position) : list.map((part) => changed(part, change));
}

/** A feature of a collection, its properties as they were sent. */
export function featureOf(collection: string, source: GeoJsonFeature, change: Change): Feature {
  const feature = new Feature(geometryOf(source.geometry, change) ?? undefined);
  feature.setId(`${collection}/${source.id ?? ""}`);
  feature.set("row", source.properties ?? {}, true);
  return feature;
}

/** The properties that the service sent with a feature. */
export function rowOf(feature: { get(name: string): unknown }): Properties {
  return (feature.get("row") as Properties | undefined) ?? {};
}

/** A point inside an area. */
export function pointInside(feature: Feature): Position | undefined {
  const geometry = feature.getGeometry();
  const inside =
    geometry instanceof Polygon
      ? geometry.getInteriorPoint()
      : geometry instanceof MultiPolygon
        ? geometry.getInteriorPoints().getPoint(0)
        : undefined;
  const [x, y] = inside?.getCoordinates() ?? [];
  return x === undefined || y === undefined ? undefined : [x, y];
}
