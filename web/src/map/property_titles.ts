/** What the properties of a collection are called for people, as the service tells it. */

import { get } from "../service/request";

interface Schema {
  readonly properties: Readonly<Record<string, { readonly title?: string; readonly "x-ogc-unit"?: string }>>;
}

type Titles = ReadonlyMap<string, string>;

const known = new Map<string, Promise<Titles>>();

/** The titles of a collection with their units, by the names of its properties; they are the same for every map. */
export function propertyTitles(map: string, collection: string): Promise<Titles> {
  const asked = known.get(collection) ?? read(map, collection);
  known.set(collection, asked);
  // What failed is asked again next time.
  asked.catch(() => known.delete(collection));
  return asked;
}

async function read(map: string, collection: string): Promise<Titles> {
  const { properties } = await get<Schema>(`v1/maps/${map}/collections/${collection}/schema`);
  return new Map(
    Object.entries(properties).map(([name, { title = name, "x-ogc-unit": unit }]) => [
      name,
      unit ? `${title}, ${readable(unit)}` : title,
    ]),
  );
}

/** A unit as people write it: the service tells it in UCUM. */
function readable(unit: string): string {
  return unit.replace(/^deg$/, "°").replace(/2$/, "²");
}
