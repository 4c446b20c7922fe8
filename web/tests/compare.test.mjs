/** Comparing: two versions of the labels, two scans of a site. */

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";

import { uploadMessage } from "./halls.mjs";
import {
  changeLabels,
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

before(async () => {
  service = await startService();
  map = await uploadExample(service.base, "Hall 1");
  ({ browser, page, complaints } = await startBrowser());
});
after(async () => {
  await browser?.close();
  await service?.stop();
});

const choose = async (name) => {
  const select = page.getByLabel("Compare with");
  const option = select.locator("option", { hasText: name });
  await option.waitFor({ state: "attached" });
  await select.selectOption(await option.getAttribute("value"));
};

test("a version is laid beside the one in force, and each change leads to its place", async () => {
  const { body } = await json(service.base, `/v1/maps/${map}/collections/faces/items?label=pc&limit=2`);
  const [first, second] = body.features.map(({ id }) => id);
  await changeLabels(service.base, map, { overrides: { [first]: "ro", [second]: "ju" } });
  await openMap(page, service.base, map, "compare");
  await choose("Version 0");
  await page.getByText("Faces with another label: 2").waitFor();
  await page.getByText("Locations removed: 2").waitFor();
  await page.waitForTimeout(500);
  await picture(page, "compare-versions");
  const before = page.url();
  await page.getByRole("button", { name: new RegExp(`Face ${first}: .* → room`) }).click();
  await page.waitForTimeout(500);
  assert.notEqual(page.url(), before);
});

test("the divider is moved by keys and shows the labels of either side", async () => {
  const pixel = async () => {
    const { x, y, width, height } = await page.locator(".canvas").boundingBox();
    const clip = { x: x + width / 2 - 30, y: y + height / 2 - 12, width: 20, height: 8 };
    return (await page.screenshot({ clip })).toString("base64");
  };
  const divider = page.getByLabel("Divider between the two");
  const sides = [];
  for (const key of ["Home", "End"]) {
    await divider.press(key);
    await page.waitForTimeout(400);
    sides.push(await pixel());
  }
  assert.notEqual(sides[0], sides[1]);
});

test("another scan of the site is laid on the map: what moved, went and came is told", async () => {
  const form = new FormData();
  const metadata = (await readFile(EXAMPLE.metadata, "utf8")).replace(/origin: .*/, "origin: [1.5, -2.0, 0.0]");
  form.append("image", new Blob([await readFile(EXAMPLE.image)]), "warehouse.png");
  form.append("metadata", new Blob([metadata]), "warehouse.yaml");
  form.append("name", "Second scan");
  form.append("previous", map);
  const { body: job } = await json(service.base, "/v1/maps", { method: "POST", body: form });
  await (await fetch(`${service.base}/v1/jobs/${job.jobID}/events`)).text();
  // Labels come along; what is decided later does not.
  const { body } = await json(service.base, `/v1/maps/${map}/collections/faces/items?label=pc&limit=2`);
  await changeLabels(service.base, map, { overrides: Object.fromEntries(body.features.map(({ id }) => [id, "ro"])) });
  await openMap(page, service.base, map, "look");
  await page.getByRole("button", { name: "Show all" }).click();
  await page.waitForTimeout(500);
  await openMap(page, service.base, map, "compare");
  await choose("Second scan");
  await page.getByText("From “Hall 1” to “Second scan”").waitFor();
  await page.getByText(/locations are as they were/).waitFor();
  await page.getByText("Locations added: 2").waitFor();
  await page.waitForTimeout(500);
  await picture(page, "compare");
});

test("another analysis is compared without being in force, put in force, and undone", async () => {
  const headers = { "content-type": "application/json" };
  const options = { decomposition: { method: "paper" } };
  const path = `/v1/maps/${map}/analyses`;
  const { body: job } = await json(service.base, path, { method: "POST", headers, body: JSON.stringify(options) });
  await (await fetch(`${service.base}/v1/jobs/${job.jobID}/events`)).text();
  const inForce = async () => (await json(service.base, path)).body.analyses.find((one) => one.inForce).id;
  const first = await inForce();
  await openMap(page, service.base, map, "look");
  await openMap(page, service.base, map, "compare");
  await choose("Analysis, ");
  await page.getByText("Method (decomposition/method): adaptive → paper").waitFor();
  await page.getByText(/^Faces: \d+ added/).waitFor();
  await page.getByText(/Labels that people gave: \d+ would be kept, \d+ lost/).waitFor();
  await page.getByText(/Locations removed: \d+/).waitFor();
  await page.waitForTimeout(500);
  await picture(page, "compare-analyses");
  assert.equal(await inForce(), first, "nobody sees it");
  const address = page.url();
  await page.getByRole("button", { name: "Put in force" }).click();
  await page
    .getByRole("dialog")
    .getByRole("button", { name: /Keep|Cancel/ })
    .click();
  assert.equal(await inForce(), first, "nothing happens before it is agreed to");
  await page.getByRole("button", { name: "Put in force" }).click();
  await page
    .getByRole("dialog")
    .getByText(/Everybody sees it then/)
    .waitFor();
  await picture(page, "activate-question");
  await page.getByRole("dialog").getByRole("button", { name: "Put in force" }).click();
  await page.getByText("The other analysis is in force now").waitFor();
  assert.notEqual(await inForce(), first);
  await page.getByText("Method (decomposition/method): paper → adaptive").waitFor();
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByText("Method (decomposition/method): adaptive → paper").waitFor();
  assert.equal(await inForce(), first);
  await openMap(page, service.base, map, "look");
  await page.goto(address);
  await page.getByText(/Locations removed: \d+/).waitFor();
});

test("a map of another building is refused with the reason", async () => {
  const rows = Array.from({ length: 80 }, (_, y) =>
    Array.from({ length: 60 }, (_, x) => (x % 59 === 0 || y % 79 === 0 || (x === 30 && y < 50) ? 100 : 0)),
  );
  const message = {
    info: { resolution: 0.1, width: 60, height: 80, origin: { position: { x: 0, y: 0, z: 0 } } },
    data: rows.flat(),
  };
  await uploadMessage(service.base, { name: "Office" }, message);
  await openMap(page, service.base, map, "look");
  await openMap(page, service.base, map, "compare");
  await choose("Office");
  await page.locator(".problem").waitFor();
});

test("the page had nothing to complain about", () => assert.deepEqual(complaints, []));
