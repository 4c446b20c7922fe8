// What the TypeScript client of openapi-generator makes of a service: node typescript_fetch.js MAP_URL.

import assert from "node:assert/strict";
import { Configuration, FeaturesApi, FleetApi, MapsApi } from "./client/index";

async function read(mapUrl: string): Promise<void> {
  const [service, mapId] = mapUrl.split("/v1/maps/") as [string, string];
  const configuration = new Configuration({ basePath: service });
  const [maps, features, fleet] = [new MapsApi(configuration), new FeaturesApi(configuration), new FleetApi(configuration)];

  const listed = (await maps.listMaps()).maps.map((one) => one.id);
  assert(listed.includes(mapId), listed.join());
  assert.equal((await maps.getMap({ mapId })).width, 1042);
  assert.equal((await maps.getImage({ mapId })).type, "image/png");

  const page = await features.getFeaturesOfFaces({ mapId, label: "co", crs: "EPSG:3857", limit: 10 });
  assert.equal(page.numberReturned, 5);
  assert.equal((page.features[0]!.properties as { label: string }).label, "co");

  const route = await fleet.getRoute({ mapId, from: "-15,-5", to: "location:02-007", crs: "EPSG:3857" });
  assert(route.properties.lengthM > 10);
  assert.equal(route.properties.instructions[0]!.action, "depart");
}

void read(process.argv[2]!);
