/** What a thing on the map is called. */

import type Feature from "ol/Feature";

import { t } from "../../language";
import { rowOf } from "../../map/geojson";
import type { TextName } from "../../texts/texts";

/** What one thing of a collection is called. */
const ONE = {
  faces: "oneFace",
  edges: "oneEdge",
  locations: "oneLocation",
  places: "onePlace",
  doors: "oneDoor",
  lines: "oneLine",
  regions: "oneRegion",
  nodes: "oneNode",
  links: "oneLink",
} as const satisfies Record<string, TextName>;

/** The collection of a feature, and its id there. */
export function addressOf(feature: Feature): readonly [collection: string, id: string] {
  const [collection = "", ...id] = String(feature.getId()).split("/");
  return [collection, id.join("/")];
}

/** Its kind and number, what its label is called, and the name that people gave it. */
export function featureName(feature: Feature): string {
  const [collection, id] = addressOf(feature);
  const kind = collection in ONE ? t(ONE[collection as keyof typeof ONE]) : collection;
  const row = rowOf(feature);
  return [`${kind} ${id}`, row["labelName"], row["name"], row["cogency"]].filter(Boolean).join(" · ");
}
