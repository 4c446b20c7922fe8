/** One map: looking, deciding, routes, handing over. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import {
  changeLabels,
  clickMap,
  EXAMPLE,
  json,
  openMap,
  picture,
  startBrowser,
  startService,
  uploadExample,
} from "./service.mjs";

let service;
let browser;
let page;
let complaints;
let map;
let location;

const semantics = async () => (await json(service.base, `/v1/maps/${map}/semantics`)).body;

before(async () => {
  service = await startService();
  map = await uploadExample(service.base, "Hall 1");
  const { body } = await json(service.base, `/v1/maps/${map}/collections/locations/items?limit=1&crs=EPSG:3857`);
  location = body.features[0].properties;
  ({ browser, page, complaints } = await startBrowser());
});
after(async () => {
  await browser?.close();
  await service?.stop();
});

test("a click tells all that is known of a place", async () => {
  await openMap(page, service.base, map);
  await clickMap(page, location.centre);
  const inspector = page.getByRole("complementary", { name: "Properties" });
  await inspector.getByText("Area, m²").first().waitFor();
  await inspector
    .locator("summary", { hasText: /^(Face|Location) / })
    .first()
    .waitFor();
  const link = await inspector.getByRole("link", { name: "JSON" }).first().getAttribute("href");
  assert.match(link, new RegExp(`^v1/maps/${map}/collections/\\w+/items/`));
  await picture(page, "look");
});

test("a code is searched and flown to, and the address holds the view", async () => {
  await page.getByLabel("Search a code or a name").fill(location.code);
  await page.locator(".answers").getByRole("button").first().click();
  await page.waitForTimeout(700);
  const address = page.url();
  const view = new URLSearchParams(address.split("?")[1]);
  assert.ok(Math.hypot(view.get("x") - location.centre[0], view.get("y") - location.centre[1]) < 5, address);
  await page.goto("about:blank");
  await page.goto(address);
  await page.locator("a[role=tab]").first().waitFor();
  await page.waitForTimeout(500);
  assert.equal(page.url(), address);
});

test("layers are shown and hidden, and the address says which", async () => {
  for (const name of ["Occupancy", "Adjacency graph", "Regions", "Lines", "Places"])
    await page.getByLabel(name, { exact: true }).check();
  await page.waitForLoadState("networkidle");
  assert.match(page.url(), /layers=regions%2Cfaces%2Coccupancy%2Cplaces%2Clines%2Cedges%2Cgraph/);
  await picture(page, "layers");
  for (const name of ["Occupancy", "Adjacency graph", "Regions", "Lines", "Places"])
    await page.getByLabel(name, { exact: true }).uncheck();
  assert.doesNotMatch(page.url(), /layers=/);
});

test("a length is measured", async () => {
  await page.getByRole("button", { name: "Show all" }).click();
  await page.waitForTimeout(500);
  await page.getByRole("button", { name: "Measure" }).click();
  const [x, y] = location.centre;
  await clickMap(page, [x, y]);
  await clickMap(page, [x + 3, y]);
  await page.getByText(/^3\.\d\d m$/).waitFor();
  await page.keyboard.press("Escape");
});

test("a category is decided: seen at once, saved as a version, undone, redone", async () => {
  await openMap(page, service.base, map, "decide");
  const category = page.locator("section.category").first();
  const id = (await category.getAttribute("id")).replace("category-", "");
  const before = (await semantics()).assignment[id];
  const other = before === "co" ? "ju" : "co";
  await category.getByRole("combobox").selectOption(other);
  await page.getByText("Changes: 1", { exact: true }).waitFor();
  const faces = (await json(service.base, `/v1/maps/${map}/collections/faces/items?category=${id}&limit=1`)).body;
  await page.getByText(`Faces with another label: ${faces.numberMatched}`).waitFor();
  assert.equal((await semantics()).version, 0, "nothing is stored before it is saved");
  await picture(page, "decide");
  await page.getByRole("button", { name: "Save" }).click();
  await page.getByText("Version 1 is in force").waitFor();
  assert.equal((await semantics()).assignment[id], other);
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByText("Version 2 is in force").waitFor();
  assert.equal((await semantics()).assignment[id], before);
  await page.getByRole("button", { name: "Redo" }).click();
  await page.getByText("Version 3 is in force").waitFor();
  assert.equal((await semantics()).assignment[id], other);
  await page.getByText("History").click();
  await page.getByRole("button", { name: "Restore version 0" }).click();
  await page.getByText("Version 4 is in force").waitFor();
  assert.equal((await semantics()).assignment[id], before);
});

test("a focused category takes its label by a key; a draft outlives the page and a service that is gone", async () => {
  const category = page.locator("section.category").nth(1);
  const select = category.getByRole("combobox");
  const other = (await select.inputValue()) === "ro" ? "1" : "4";
  await category.focus();
  await page.keyboard.press(other);
  await page.getByText("Changes: 1", { exact: true }).waitFor();
  await page.reload();
  await page.getByText("Changes: 1", { exact: true }).waitFor();
  await page.route("**/semantics", (route) => route.abort());
  await page.getByRole("button", { name: "Save" }).click();
  await page.locator(".problem", { hasText: "The service does not answer" }).waitFor();
  await page.getByText("Changes: 1", { exact: true }).waitFor();
  await page.unroute("**/semantics");
  await page.getByRole("button", { name: "Save" }).click();
  await page.getByText("Version 5 is in force").waitFor();
  assert.equal(await page.locator(".problem").count(), 0);
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByText("Version 6 is in force").waitFor();
});

test("faces get a label of their own", async () => {
  await clickMap(page, location.centre);
  await page.getByText("1 faces chosen").waitFor();
  await page.keyboard.press("4");
  await page.getByText("1 faces changed, not saved").waitFor();
  await page.getByRole("button", { name: "Save" }).click();
  await page.getByText("Version 7 is in force").waitFor();
  assert.deepEqual(
    (await semantics()).overrides.map(({ label }) => label),
    ["ro"],
  );
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByText("Version 8 is in force").waitFor();
});

test("where somebody else saved meanwhile, their change is shown and nothing is lost", async () => {
  const [first, second] = await page
    .locator("section.category")
    .evaluateAll((all) => all.map((one) => one.id.replace("category-", "")));
  await page.locator(`#category-${second}`).getByRole("combobox").selectOption("ro");
  await changeLabels(service.base, map, { assignment: { [first]: "un" } });
  await page.getByRole("button", { name: "Save" }).click();
  await page.getByText("Somebody else saved meanwhile").waitFor();
  await page.getByText(new RegExp(`Category ${first}: .* → unidentified`)).waitFor();
  await page.getByText("Changes: 1", { exact: true }).waitFor();
  await picture(page, "conflict");
  await page.getByRole("button", { name: "Save" }).click();
  await page.getByText("Version 10 is in force").waitFor();
  const { assignment } = await semantics();
  assert.deepEqual([assignment[first], assignment[second]], ["un", "ro"]);
  await page.getByText("History").click();
  await page.getByRole("button", { name: "Restore version 0" }).click();
  await page.getByText("Version 11 is in force").waitFor();
});

test("a rule set is made of a built-in one, with a rule of its own", async () => {
  await page.getByRole("button", { name: "Edit labels and rules" }).click();
  await page.getByLabel("Id", { exact: true }).fill("hall");
  await page.getByLabel("Name 4").fill("workshop");
  await page.keyboard.press("Tab");
  await page.getByLabel("pallet cell and corridor").selectOption("cogent");
  await picture(page, "rules");
  await page.getByRole("button", { name: "Try on the map" }).click();
  await page.getByRole("dialog").waitFor({ state: "detached" });
  await page.getByText("Edges: obstruction").waitFor();
  await picture(page, "rules-tried");
  assert.equal((await fetch(`${service.base}/v1/rule-sets/hall`)).status, 404, "nothing is stored before it is saved");
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await page.getByText("Version 12 is in force").waitFor();
  const { body } = await json(service.base, "/v1/rule-sets/hall");
  assert.deepEqual(body.cogency, [{ when: ["pc", "co"], then: "cogent" }]);
  assert.equal(body.labels[3].name, "workshop");
  assert.equal((await semantics()).ruleSet, "hall");
});

test("a rule set that somebody else changed meanwhile is not overwritten before that is told", async () => {
  await page.getByRole("button", { name: "Edit labels and rules" }).click();
  await page.getByLabel("Name 4").fill("office");
  await page.getByRole("button", { name: "Try on the map" }).click();
  const { body, tag } = await json(service.base, "/v1/rule-sets/hall");
  const headers = { "content-type": "application/json", "if-match": tag };
  const theirs = { labels: body.labels.map((label) => ({ ...label, color: "#123456" })) };
  await json(service.base, "/v1/rule-sets/hall", { method: "PUT", headers, body: JSON.stringify(theirs) });
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await page.getByText("The labels or rules of the rule set").waitFor();
  await page.getByRole("button", { name: "Save", exact: true }).click();
  await page.getByText("is in force").waitFor();
  assert.equal((await json(service.base, "/v1/rule-sets/hall")).body.labels[3].name, "office");
  await changeLabels(service.base, map, { ruleSet: "site" });
});

test("a route is clicked, told and drawn; a vehicle that is too wide is told why", async () => {
  await openMap(page, service.base, map, "routes");
  const { body } = await json(service.base, `/v1/maps/${map}/collections/locations/items?limit=200&crs=EPSG:3857`);
  await clickMap(page, location.centre);
  await clickMap(page, body.features.at(-1).properties.centre);
  assert.equal(await page.getByLabel("From", { exact: true }).inputValue(), `location:${location.code}`);
  await page.getByText(/m, .* s, .* m from obstacles/).waitFor();
  await page.locator("ol.steps li").first().waitFor();
  await picture(page, "route");
  await page.getByLabel("Vehicle", { exact: true }).fill("1.5");
  await page.locator(".problem", { hasText: "No route" }).waitFor();
  await page.getByText("Report on the navigation graph").click();
  await page.getByText(/nodes, .* lanes/).waitFor();
  await picture(page, "graph-report");
});

test("locations are listed, sorted and filtered; files are offered with their options", async () => {
  await openMap(page, service.base, map, "hand-over");
  const codes = page.locator("tbody tr td:first-child");
  await codes.first().waitFor();
  const first = await codes.first().textContent();
  await page.getByRole("button", { name: /^Code/ }).click();
  await page.getByRole("button", { name: "Code ▼" }).waitFor();
  assert.notEqual(await codes.first().textContent(), first);
  await page.getByLabel("Filter").fill(first);
  assert.equal(await codes.count(), 1);
  const lif = page.locator("details", { hasText: "lif.json" });
  await lif.locator("summary").click();
  await lif.getByLabel("footprintRadiusM").fill("x");
  await lif.getByRole("button", { name: "Preview" }).click();
  await lif.locator(".problem").waitFor();
  await lif.getByLabel("footprintRadiusM").fill("0.35");
  await lif.getByRole("button", { name: "Preview" }).click();
  await lif.locator("pre", { hasText: "metaInformation" }).waitFor();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    lif.getByRole("link", { name: "Download" }).click(),
  ]);
  assert.equal(download.suggestedFilename(), "lif.json");
});

test("files and their options are explained in German, every one", async () => {
  const { body } = await json(service.base, `/v1/maps/${map}/exports`);
  await page.getByLabel("Language").selectOption("de");
  await page.getByRole("heading", { name: "Dateien für andere Programme" }).waitFor();
  const texts = await page.locator("section[aria-labelledby=exports-title] small").allTextContents();
  const english = body.exports.flatMap(({ purpose, options }) => [purpose, ...options.map((one) => one.description)]);
  await page.getByText("Routengraph von Nav2").waitFor();
  assert.deepEqual(
    texts.filter((text) => english.includes(text)),
    [],
  );
  assert.equal(texts.length, english.length);
  await page.getByLabel("Sprache").selectOption("en");
});

test("the map is compared with its truth, which is drawn over it", async () => {
  await page.getByLabel("Truth file").setInputFiles(EXAMPLE.truth.pathname);
  await page.getByText("Places found").waitFor();
  await page.locator(".panel").evaluate((panel) => panel.scrollTo(0, panel.scrollHeight));
  await picture(page, "evaluation");
});

test("a service that ends and comes back loses no draft: its effect is told and it is saved", async () => {
  await page.reload();
  await openMap(page, service.base, map, "decide");
  const select = page.locator("section.category").first().getByRole("combobox");
  const other = (await select.inputValue()) === "co" ? "ju" : "co";
  await service.interrupt();
  await select.selectOption(other);
  await page.getByText("It is asked again until it does").waitFor();
  await page.getByText("Changes: 1", { exact: true }).waitFor();
  await picture(page, "gone");
  await service.resume();
  await page.getByText("It is asked again until it does").waitFor({ state: "detached" });
  await page.getByText("Faces with another label").waitFor();
  await page.getByRole("button", { name: "Save" }).click();
  await page.getByText(/Version \d+ is in force/).waitFor();
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByText(/Version \d+ is in force/).waitFor();
});

test("a map that is opened while the service is gone is there once it is back", async () => {
  await service.interrupt();
  await page.evaluate((map) => (location.hash = `#/maps/${map}/look`), "01a22711-7884-74c4-958b-49286e02bea9");
  await page.evaluate((map) => (location.hash = `#/maps/${map}/look`), map);
  await page.locator(".problem", { hasText: "The service does not answer" }).waitFor();
  await service.resume();
  await page.getByRole("heading", { name: "Hall 1" }).waitFor();
});

test("a georeferenced map is shown and driven on in its own metres", async () => {
  const headers = { "content-type": "application/json" };
  const georeference = { lon: 12.8572, lat: 56.6745, heading: 30 };
  await json(service.base, `/v1/maps/${map}`, { method: "PATCH", headers, body: JSON.stringify({ georeference }) });
  await page.reload();
  await openMap(page, service.base, map, "routes");
  await clickMap(page, location.centre);
  assert.equal(await page.getByLabel("From", { exact: true }).inputValue(), `location:${location.code}`);
  const { body } = await json(service.base, `/v1/maps/${map}/graph-report`);
  await clickMap(page, body.graphComponents[0].position);
  await page.getByText(/m, .* s, .* m from obstacles/).waitFor();
});

test("the page had nothing to complain about", () => assert.deepEqual(complaints, []));
