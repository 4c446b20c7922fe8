/** Texts of users are texts: markup in names, codes, labels, file names and files runs nowhere. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { changeLabels, json, openMap, startBrowser, startService, uploadExample } from "./service.mjs";

const MARKUP = '<img src=x onerror="globalThis.harmed=true">';
const PAYLOADS = [
  MARKUP,
  "<script>globalThis.harmed=true</script>",
  "<svg/onload=globalThis.harmed=true>",
  "javascript:globalThis.harmed=true",
  '"><b onmouseover=globalThis.harmed=true>',
];
let service;
let browser;
let page;
let complaints;
let map;

before(async () => {
  service = await startService();
  map = await uploadExample(service.base, MARKUP);
  const rules = (await json(service.base, "/v1/rule-sets/site")).body;
  const labels = rules.labels.map((label, index) => ({ ...label, name: PAYLOADS[index] }));
  const headers = { "content-type": "application/json" };
  await json(service.base, "/v1/rule-sets", {
    method: "POST",
    headers,
    body: JSON.stringify({ id: "hostile", labels }),
  });
  await changeLabels(service.base, map, { ruleSet: "hostile" });
  const items = `/v1/maps/${map}/collections/locations/items`;
  const { body } = await json(service.base, `${items}?limit=1`);
  const path = `${items}/${body.features[0].id}`;
  const { tag } = await json(service.base, path);
  await json(service.base, path, {
    method: "PATCH",
    headers: { ...headers, "if-match": tag },
    body: JSON.stringify({ properties: { name: MARKUP } }),
  });
  ({ browser, page, complaints } = await startBrowser());
});
after(async () => {
  await browser?.close();
  await service?.stop();
});

const isHarmed = () =>
  page.evaluate(
    () => globalThis.harmed === true || document.querySelector("main img[src=x], main b, main svg") !== null,
  );

test("names of maps and files", async () => {
  await page.goto(service.base);
  await page.getByRole("link", { name: MARKUP }).waitFor();
  await page.setInputFiles("#files", { name: `${MARKUP}.png`, mimeType: "image/png", buffer: Buffer.from("x") });
  await page.locator(".chip", { hasText: "onerror" }).waitFor();
  await page.getByRole("button", { name: `Delete ${MARKUP}` }).click();
  await page.getByRole("dialog").getByText("onerror").waitFor();
  await page.getByRole("button", { name: "Keep" }).click();
  assert.equal(await isHarmed(), false);
});

test("labels and names on the map, in the legend, in the search and in the table", async () => {
  await openMap(page, service.base, map, "look");
  await page.locator(".legend", { hasText: "onerror" }).first().waitFor();
  await page.getByLabel("Search a code or a name").fill("onerror");
  await page.locator(".answers button").first().click();
  await page.getByRole("complementary", { name: "Properties" }).getByText("onerror").first().waitFor();
  await openMap(page, service.base, map, "decide");
  await page.locator(".category option", { hasText: "onerror" }).first().waitFor({ state: "attached" });
  await openMap(page, service.base, map, "hand-over");
  await page.getByLabel("Filter").fill("onerror");
  await page.locator("tbody td", { hasText: "onerror" }).first().waitFor();
  assert.equal(await isHarmed(), false);
});

test("what the service says of hostile input", async () => {
  await openMap(page, service.base, map, "routes");
  await page.getByLabel("From", { exact: true }).fill(`location:${MARKUP}`);
  await page.getByLabel("To", { exact: true }).fill("0,0");
  await page.getByLabel("To", { exact: true }).press("Enter");
  await page.locator(".problem").waitFor();
  assert.equal(await isHarmed(), false);
});

test("a truth file with markup in it", async () => {
  await openMap(page, service.base, map, "hand-over");
  const truth = {
    type: "FeatureCollection",
    features: [{ type: "Feature", properties: { label: MARKUP }, geometry: { type: MARKUP, coordinates: [] } }],
  };
  await page
    .getByLabel("Truth file")
    .setInputFiles({ name: "truth.geojson", mimeType: "application/json", buffer: Buffer.from(JSON.stringify(truth)) });
  await page.locator(".problem").waitFor();
  assert.equal(await isHarmed(), false);
});

test("an address with markup in it opens nothing", async () => {
  await page.goto(`${service.base}/#/maps/${encodeURIComponent(MARKUP)}/look?layers=${MARKUP}`);
  await page.getByRole("heading", { name: "Maps", exact: true }).waitFor();
  assert.equal(await isHarmed(), false);
  assert.deepEqual(complaints, []);
});
