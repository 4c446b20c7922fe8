/** The collections of a map, each read once and kept until labels change. */

import VectorSource from "ol/source/Vector";

import { nextPath } from "../service/maps";
import { get } from "../service/request";
import type { Coordinates } from "./coordinates";
import { featureOf, type GeoJsonFeature } from "./geojson";

/** The most features that the service answers at once. */
const PAGE = 10_000;

interface ItemsPage {
  readonly features: readonly GeoJsonFeature[];
  readonly links: readonly { rel: string; href: string }[];
}

export class Collections {
  private readonly sources = new Map<string, VectorSource>();
  private readonly readings = new Map<string, Promise<VectorSource>>();

  private readonly listeners = new Set<() => void>();

  constructor(
    private readonly map: string,
    private readonly coordinates: Coordinates,
  ) {}

  /** The source of a collection, filled or still to fill. */
  source(collection: string): VectorSource {
    const known = this.sources.get(collection) ?? new VectorSource();
    this.sources.set(collection, known);
    return known;
  }

  /** The source of a collection once it is filled. */
  read(collection: string): Promise<VectorSource> {
    const reading = this.readings.get(collection) ?? this.fill(collection);
    this.readings.set(collection, reading);
    // What failed is asked again next time.
    reading.catch(() => this.readings.delete(collection));
    return reading;
  }

  /** Reads all that was read before anew: the labels have changed. */
  async refresh(): Promise<void> {
    const known = [...this.readings.keys()];
    this.readings.clear();
    await Promise.all(known.map((collection) => this.read(collection)));
    for (const listener of this.listeners) listener();
  }

  /** Tells when all was read anew. Returns how to stop. */
  onRefresh(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => void this.listeners.delete(listener);
  }

  private async fill(collection: string): Promise<VectorSource> {
    const source = this.source(collection);
    const query = new URLSearchParams({ limit: String(PAGE), crs: this.coordinates.crs, f: "json" });
    let path: string | undefined = `v1/maps/${this.map}/collections/${collection}/items?${query}`;
    const features = [];
    while (path !== undefined) {
      const page: ItemsPage = await get(path);
      features.push(...page.features.map((feature) => featureOf(collection, feature, this.coordinates.toMap)));
      path = nextPath(page.links);
    }
    source.clear(true);
    source.addFeatures(features);
    return source;
  }
}
