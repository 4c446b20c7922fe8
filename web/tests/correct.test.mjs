/** Correcting: everything that a person draws, by mouse and by keys, on a real analysis. */

import assert from "node:assert/strict";
import { rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { symmetricHall, uploadMessage } from "./halls.mjs";
import { clickMap, json, onScreen, openMap, picture, startBrowser, startService } from "./service.mjs";

let service;
let browser;
let page;
let complaints;
let map;

/** In the hall, metres: racks at y 5 to 7, 11 to 13 and 17 to 19 from x 6 to 30; the rest is ground. */
before(async () => {
  service = await startService();
  map = await uploadMessage(service.base, { name: "Hall 1" }, symmetricHall());
  ({ browser, page, complaints } = await startBrowser());
  await openMap(page, service.base, map, "correct");
  await page.getByText("Corrections: 0").waitFor();
});
after(async () => {
  await browser?.close();
  await service?.stop();
});

const listed = async () => (await json(service.base, `/v1/maps/${map}/corrections`)).body;
const tool = (name) => page.getByRole("toolbar").getByRole("button", { name, exact: true });
const form = () => page.getByRole("region", { name: "The chosen correction" });
const effect = () => page.getByText(/^Faces: \d+ added/);

/** Drags from one point of the map to another, metres. */
async function drag(from, to) {
  const [begin, end] = [await onScreen(page, from), await onScreen(page, to)];
  await page.mouse.move(...begin);
  await page.mouse.down();
  await page.mouse.move((begin[0] + end[0]) / 2, (begin[1] + end[1]) / 2, { steps: 4 });
  await page.mouse.move(...end, { steps: 4 });
  await page.mouse.up();
}

async function save() {
  const { version } = await listed();
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await page.getByText(`Version ${version + 1} is in force`).waitFor();
  return (await listed()).corrections;
}

/** The label of the face at a point, as the service answers. */
async function labelAt([x, y]) {
  const box = [x - 0.01, y - 0.01, x + 0.01, y + 0.01].join();
  const path = `/v1/maps/${map}/collections/faces/items?bbox=${box}&bbox-crs=EPSG:3857&crs=EPSG:3857`;
  return (await json(service.base, path)).body.features.map(({ properties }) => properties.label).join();
}

test("a rack that was missed is dragged as a rectangle: its effect is seen before it is saved", async () => {
  await tool("Rectangle").click();
  await drag([32, 8], [34.5, 16]);
  await form().waitFor();
  await effect().waitFor();
  assert.equal((await listed()).version, 0, "nothing is stored before it is saved");
  const [correction] = await save();
  assert.deepEqual([correction.kind, correction.label, correction.isApplied], ["draw", "pc", true]);
  assert.equal(await labelAt([33, 12]), "pc");
});

test("a row is dragged, a number is typed: its places appear at once, and are there once it is saved", async () => {
  await tool("Row of places").click();
  await drag([8, 7.6], [28, 8.8]);
  await form().getByLabel("Places", { exact: true }).fill("10");
  await page.keyboard.press("Tab");
  await page.getByLabel("Places in depth").fill("2");
  await page.keyboard.press("Tab");
  await page.getByText("Row · 10 × 2 places").waitFor();
  await effect().waitFor();
  await picture(page, "correct");
  const row = (await save()).at(-1);
  assert.deepEqual([row.kind, row.places, row.layers, row.isApplied], ["row", 10, 2, true]);
  assert.equal(row.faces.length, 20);
});

test("undo and redo go over the saved versions", async () => {
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByText("Corrections: 1").waitFor();
  await page.keyboard.press("Control+Shift+Z");
  await page.getByText("Corrections: 2").waitFor();
  assert.equal((await listed()).corrections.length, 2);
});

test("a cut is drawn by keys alone, and a step back takes it from the draft", async () => {
  await page.locator(".canvas").focus();
  await page.keyboard.press("s");
  await page.getByText("Click along the cut").waitFor();
  await page.keyboard.press("Space");
  for (let step = 0; step < 20; step += 1) await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Space");
  await page.keyboard.press("Enter");
  await page.getByText("Corrections: 3").waitFor();
  await page.keyboard.press("Control+z");
  await page.getByText("Corrections: 2").waitFor();
});

test("a face is split and the halves are merged again", async () => {
  await tool("Split").click();
  for (const point of [
    [3, 0.1],
    [3, 23.9],
  ])
    await clickMap(page, point);
  await page.keyboard.press("Enter");
  const split = (await save()).at(-1);
  assert.deepEqual([split.kind, split.isApplied], ["split", true]);
  await tool("Merge").click();
  for (const point of [
    [1.5, 12],
    [4.5, 12],
  ])
    await clickMap(page, point);
  await page.keyboard.press("Enter");
  const merge = (await save()).at(-1);
  assert.deepEqual([merge.kind, merge.isApplied, merge.reason], ["merge", true, undefined]);
});

test("a face gets a label, another one a name", async () => {
  await tool("Label").click();
  await clickMap(page, [33, 3]);
  await form().getByRole("combobox").selectOption("ro");
  await tool("Name").click();
  await clickMap(page, [1.5, 20]);
  await form().getByLabel("Name").fill("Cold store");
  await page.keyboard.press("Tab");
  await page.getByText("Name · Cold store").waitFor();
  const [label, name] = (await save()).slice(-2);
  assert.deepEqual([label.label, label.isApplied, name.name, name.isApplied], ["ro", true, "Cold store", true]);
});

test("what was found there is erased, and a door is set", async () => {
  await tool("Erase").click();
  for (const point of [
    [25.5, 10.5],
    [30.5, 10.5],
    [30.5, 13.5],
    [25.5, 13.5],
  ])
    await clickMap(page, point);
  await page.keyboard.press("Enter");
  await tool("Door").click();
  await clickMap(page, [7.2, 14]);
  await clickMap(page, [7.2, 16]);
  const [erased, door] = (await save()).slice(-2);
  assert.deepEqual([erased.kind, erased.isApplied], ["erase", true]);
  assert.deepEqual([door.kind, door.isOpen], ["door", true]);
});

test("a corner is moved on the map and by figures, and the shape is aligned", async () => {
  await page
    .getByRole("button", { name: /^Area · / })
    .first()
    .click();
  await page.waitForTimeout(700);
  const before = (await listed()).corrections[0].ring;
  await drag(before[2], [before[2][0] - 0.4, before[2][1] + 0.9]);
  await page.getByText("Changes: 1").waitFor();
  await page.getByRole("button", { name: "Align" }).click();
  await page.getByText("4 points, metres").click();
  await page.getByLabel("x of point 1").fill("31.50");
  await page.keyboard.press("Tab");
  const after = (await save())[0].ring;
  assert.ok(Math.abs(after[0][0] - 31.5) < 1e-6, JSON.stringify(after));
  assert.notDeepEqual(after[2], before[2]);
});

test("what does not fit is told with its reason, and a shape that crosses itself at once", async () => {
  await page.getByRole("tab", { name: "Look" }).click();
  await page.getByRole("button", { name: "Show all" }).click();
  await page.waitForTimeout(500);
  await page.getByRole("tab", { name: "Correct" }).click();
  await tool("Split").click();
  await clickMap(page, [2, 26]);
  await clickMap(page, [6, 26]);
  await page.keyboard.press("Enter");
  await page.locator(".corrections .warning, .bar .problem").first().waitFor();
  await picture(page, "correct-misfit");
  await page.keyboard.press("Control+z");
  await tool("Polygon").click();
  for (const point of [
    [31, 18],
    [35, 22],
    [35, 18],
    [31, 22],
  ])
    await clickMap(page, point);
  await page.keyboard.press("Enter");
  await page.getByText("Its sides cross one another").waitFor();
  await page.getByRole("button", { name: "Discard" }).click();
});

test("a draft outlives a closed page and a service that ends", async () => {
  await tool("Label").click();
  await clickMap(page, [15, 15]);
  await page.getByText("Changes: 1").waitFor();
  await service.interrupt();
  await page.keyboard.press("1");
  await page.getByText("It is asked again until it does").waitFor();
  await service.resume();
  await page.reload();
  await page.getByText("Changes: 1").waitFor();
  await effect().waitFor();
  await save();
});

test("where somebody else saved meanwhile, their correction is shown and one's own stays", async () => {
  await tool("Label").click();
  await clickMap(page, [33, 20]);
  await effect().waitFor();
  const { tag, body } = await json(service.base, `/v1/maps/${map}/corrections`);
  const headers = { "content-type": "application/json", "if-match": tag };
  const theirs = { kind: "name", at: [3, 12], name: "Their name" };
  await json(service.base, `/v1/maps/${map}/corrections`, { method: "POST", headers, body: JSON.stringify(theirs) });
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await page.getByText("Somebody else saved meanwhile").waitFor();
  await page.getByText("added: Name · Their name").waitFor();
  await picture(page, "correct-conflict");
  const corrections = await save();
  assert.equal(corrections.length, body.corrections.length + 2);
});

test("a correction is taken away from the list", async () => {
  const { length } = (await listed()).corrections;
  await page.getByRole("button", { name: "Remove Name · Their name" }).click();
  assert.equal((await save()).length, length - 1);
});

test("an earlier version is laid beside the corrected map: faces that came, went and changed are listed", async () => {
  await page.getByRole("tab", { name: "Compare" }).click();
  const select = page.getByLabel("Compare with");
  await select.locator("option", { hasText: "Version 0" }).waitFor({ state: "attached" });
  await select.selectOption("version 0");
  await page.getByText(/^ ?Faces added: \d+/).waitFor();
  await page.getByText(/^ ?Faces with another shape: \d+/).waitFor();
  await page.waitForTimeout(500);
  await picture(page, "compare-corrections");
  await page.getByRole("tab", { name: "Correct" }).click();
  await page.getByText(/^Corrections: \d+/).waitFor();
});

test("a correction outlives another analysis", async () => {
  const before = (await listed()).corrections.map(({ id }) => id);
  const headers = { "content-type": "application/json" };
  const path = `/v1/maps/${map}/analyses`;
  const wish = { method: "POST", headers, body: JSON.stringify({ decomposition: { method: "paper" } }) };
  const { body: job } = await json(service.base, `${path}?activate=true`, wish);
  await (await fetch(`${service.base}/v1/jobs/${job.jobID}/events`)).text();
  await page.reload();
  await page.getByText(`Corrections: ${before.length}`).waitFor();
  assert.deepEqual(
    (await listed()).corrections.map(({ id }) => id),
    before,
  );
  await picture(page, "correct-another-analysis");
});

const plan = (features) => JSON.stringify({ type: "FeatureCollection", features });
const square = (x, y, properties) => ({
  type: "Feature",
  properties,
  geometry: {
    type: "Polygon",
    coordinates: [
      [
        [x, y],
        [x + 1, y],
        [x + 1, y + 1],
        [x, y + 1],
        [x, y],
      ],
    ],
  },
});
const importPlan = (text) =>
  page
    .getByLabel("GeoJSON file")
    .setInputFiles({ name: "plan.geojson", mimeType: "application/json", buffer: Buffer.from(text) });

test("racks of a building plan are imported; markup in their names runs nowhere", async () => {
  const markup = '<img src=x onerror="globalThis.harmed=true">';
  await page.getByText("Import from a file").click();
  await importPlan(plan([square(8, 14.2, { label: "pc", name: markup }), square(10, 14.2, { label: "pc" })]));
  await page.getByText("2 corrections imported").waitFor();
  await page
    .getByRole("button", { name: new RegExp("onerror") })
    .first()
    .waitFor();
  assert.equal(await page.evaluate(() => globalThis.harmed === true), false);
});

test("a plan that is wrong or too large is refused with the reason", async () => {
  await importPlan(plan([square(8, 14.2, { label: "<script>" })]));
  await page.locator("details .problem", { hasText: "label" }).waitFor();
  const large = join(tmpdir(), `stillage-large-${process.pid}.geojson`);
  await writeFile(large, plan(Array.from({ length: 400_000 }, () => square(1, 1, { label: "pc" }))));
  await page.getByLabel("GeoJSON file").setInputFiles(large);
  await page.locator("details .problem", { hasText: "limit" }).waitFor();
  await rm(large);
  assert.equal(
    (await listed()).corrections.some(({ label }) => label === "<script>"),
    false,
  );
});

test("the page had nothing to complain about", () => assert.deepEqual(complaints, []));
