// What @camptocamp/ogc-client makes of a map: node ogc_client.js MAP_URL.

import assert from "node:assert/strict";
import { OgcApiEndpoint } from "@camptocamp/ogc-client";

const endpoint = new OgcApiEndpoint(process.argv[2]);

assert.equal((await endpoint.info).title, "Example warehouse");
assert.equal(await endpoint.hasFeatures, true);
assert((await endpoint.conformanceClasses).some((uri) => uri.endsWith("ogcapi-features-1/1.0/conf/core")));

const collections = (await endpoint.featureCollections).map((collection) => collection.name ?? collection);
assert(collections.includes("faces") && collections.includes("locations"), collections.join());

const locations = await endpoint.getCollectionInfo("locations");
assert(locations.queryables.some((property) => property.name === "occupancy"), JSON.stringify(locations.queryables));

const items = await endpoint.getCollectionItems("locations", 2, 3);
assert.deepEqual(items.map((item) => item.id), ["01-004", "01-005"]);
const one = await endpoint.getCollectionItem("locations", items[0].id);
assert.deepEqual(one.properties, items[0].properties);
const address = await endpoint.getCollectionItemsUrl("locations", { limit: 5, query: "occupancy=empty" });
assert.equal((await (await fetch(address)).json()).features.length, 5);
console.log("ok: @camptocamp/ogc-client");
