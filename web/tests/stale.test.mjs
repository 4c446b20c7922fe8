/** What came from an earlier scan: codes and labels; and what the report on the navigation graph draws. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { symmetricHall, uploadMessage, WALLS } from "./halls.mjs";
import { changeLabels, clickMap, json, openMap, picture, startBrowser, startService } from "./service.mjs";

let service;
let browser;
let page;
let complaints;
let map;

const scan = (query, hall = symmetricHall()) => uploadMessage(service.base, query, hall);

const staleCount = async () => (await json(service.base, `/v1/maps/${map}/registry`)).body.stale;

before(async () => {
  service = await startService();
  const previous = await scan({ name: "First scan" });
  map = await scan({ name: "Second scan", previous });
  ({ browser, page, complaints } = await startBrowser());
});
after(async () => {
  await browser?.close();
  await service?.stop();
});

test("stale codes are listed, marked on the map, and one is confirmed by a click on its place", async () => {
  const count = await staleCount();
  assert.ok(count > 2, `${count} stale codes`);
  await openMap(page, service.base, map);
  await page.getByText(`Codes to be confirmed: ${count}`).waitFor();
  await page.locator("section.stale li button").first().click();
  await page.waitForTimeout(700);
  await picture(page, "stale");
  await page.getByRole("button", { name: /^It is / }).click();
  await page.getByText(`Codes to be confirmed: ${count - 1}`).waitFor();
  await page.getByRole("button", { name: /^It is / }).waitFor({ state: "detached" });
  assert.equal(await staleCount(), count - 1);
});

test("a stale place that is clicked on the map asks, too; all are confirmed at once", async () => {
  const items = `/v1/maps/${map}/collections/locations/items?stale=true&limit=1&crs=EPSG:3857`;
  const [place] = (await json(service.base, items)).body.features;
  await page.getByRole("button", { name: "Show all" }).click();
  await page.waitForTimeout(500);
  await clickMap(page, place.properties.centre);
  await page.getByRole("button", { name: `It is ${place.id}` }).waitFor();
  await page.getByRole("button", { name: "Confirm all" }).click();
  await page.getByText("Codes to be confirmed").waitFor({ state: "detached" });
  assert.equal(await staleCount(), 0);
});

test("the report draws lanes, dead ends, narrow passages and unreachable locations", async () => {
  const walled = await scan({ name: "With walls" }, symmetricHall(WALLS));
  const report = (await json(service.base, `/v1/maps/${walled}/graph-report`)).body;
  const counts = [report.deadEnds, report.narrowPassages, report.unreachableLocations].map(({ length }) => length);
  assert.ok(
    counts.every((count) => count > 0),
    `dead ends, narrow passages, unreachable locations: ${counts}`,
  );
  await openMap(page, service.base, walled, "routes");
  await page.getByText("Report on the navigation graph").click();
  await page.getByText(`Dead ends: ${counts[0]}`).waitFor();
  await page.getByText(`Narrow passages: ${counts[1]}`).waitFor();
  await page.getByText(`Unreachable locations: ${counts[2]}`).waitFor();
  await page.waitForTimeout(500);
  await picture(page, "graph-lanes");
});

test("labels of an earlier scan come along, and one whose ground is gone is told where labels are decided", async () => {
  const hall = symmetricHall(WALLS);
  const first = await scan({ name: "Before" }, hall);
  const { body } = await json(service.base, `/v1/maps/${first}/collections/locations/items?limit=1000&crs=EPSG:3857`);
  const inOrder = body.features
    .map(({ properties }) => properties)
    .sort((one, other) => one.centre[0] - other.centre[0]);
  const [left, right] = [inOrder[0], inOrder.at(-1)];
  await changeLabels(service.base, first, { overrides: { [left.face]: "ro", [right.face]: "ro" } });
  // The next scan does not show the left end of the hall.
  const shown = hall.info.width * 0.3;
  const data = hall.data.map((cell, index) => (index % hall.info.width < shown ? -1 : cell));
  const second = await scan({ name: "After", previous: first }, { ...hall, data });
  await openMap(page, service.base, second, "decide");
  await page.getByText("come from an earlier scan of the site; 1 of them were kept").waitFor();
  await page.getByText("Could not be kept: 1").waitFor();
  await picture(page, "lost-labels");
  const before = page.url();
  await page.getByRole("button", { name: `Face ${left.face}: room` }).click();
  await page.waitForFunction((before) => location.href !== before, before);
});

test("the page had nothing to complain about", () => assert.deepEqual(complaints, []));
