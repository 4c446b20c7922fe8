// An inventory system: the storage locations of a map as a table, and what has changed about them.
//
//     node build/inventory.js http://127.0.0.1:8080/v1/maps/MAP [SINCE]
//
// SINCE is the version of the labels that the inventory system knows: 0, the suggestion, when absent.

import { read } from "./ask.js";

interface Location {
  code: string;
  aisle: number | null;
  bay: number | null;
  side: string | null;
  widthM: number;
  depthM: number;
  occupancy: "occupied" | "empty" | "unknown";
}

interface Page {
  features: { properties: Location }[];
  links: { rel: string; href: string }[];
}

type Kind = "added" | "removed" | "changed";

interface Changes {
  since: number;
  version: number;
  locations: Record<Kind, { code: string }[]>;
}

/** All storage locations, page by page, with coordinates in metres of the map. */
async function* locations(mapUrl: string): AsyncGenerator<Location> {
  let page: string | undefined = `${mapUrl}/collections/locations/items?limit=100&crs=EPSG:3857`;
  while (page !== undefined) {
    const { features, links }: Page = await read<Page>(page);
    for (const feature of features) yield feature.properties;
    page = links.find((link) => link.rel === "next")?.href;
  }
}

const [mapUrl, since = "0"] = process.argv.slice(2);

const found: Location[] = [];
for await (const location of locations(mapUrl!)) found.push(location);
console.table(found, ["code", "aisle", "bay", "side", "widthM", "depthM", "occupancy"]);
const empty = found.filter((location) => location.occupancy === "empty").length;
console.log(`${found.length} locations, ${empty} of them empty`);

const changes = await read<Changes>(`${mapUrl}/changes?since=${since}`);
console.log(`Since version ${changes.since} of the labels (now version ${changes.version}):`);
for (const kind of ["added", "removed", "changed"] as const) {
  const codes = changes.locations[kind].map((location) => location.code);
  console.log(`  ${codes.length} ${kind}`, ...codes);
}
