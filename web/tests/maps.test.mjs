/** The list of maps: upload, progress, refusals that teach, deletion. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { EXAMPLE, json, picture, startBrowser, startService, upload } from "./service.mjs";

let service;
let browser;
let page;
let complaints;

before(async () => {
  service = await startService();
  ({ browser, page, complaints } = await startBrowser());
  await page.goto(service.base);
});
after(async () => {
  await browser?.close();
  await service?.stop();
});

const files = (...names) =>
  page.setInputFiles(
    "#files",
    names.map((name) => EXAMPLE[name].pathname),
  );

test("an empty service says what to do", async () => {
  await page.getByText("There is no map yet").waitFor();
});

test("a picture without its YAML is asked for it before anything is sent", async () => {
  await files("image");
  await page.getByText("The YAML is missing").waitFor();
  await page.getByRole("button", { name: "Upload and analyse" }).click();
  assert.equal(await page.getByRole("alert").filter({ hasText: "The YAML is missing" }).count(), 1);
  assert.equal((await json(service.base, "/v1/maps")).body.maps.length, 0);
});

test("an option out of its range is refused with its place and its range", async () => {
  await files("metadata");
  await page.getByText("Options of the analysis").click();
  const gradient = page.getByLabel("Bins", { exact: true });
  await page.getByText("Bins of the histogram over half a turn. (orientation/bins)").waitFor();
  await gradient.fill("5");
  await page.evaluate(() => (document.querySelector("form.upload").noValidate = true));
  await page.getByRole("button", { name: "Upload and analyse" }).click();
  await page.locator(".problem code", { hasText: "/options/orientation/bins" }).waitFor();
  await picture(page, "refusal");
  await gradient.fill("");
});

test("options are explained in German too", async () => {
  await page.getByLabel("Language").selectOption("de");
  await page.getByText("Optionen der Analyse").click();
  await page.getByText("Klassen des Histogramms über eine halbe Drehung. (orientation/bins)").waitFor();
  await picture(page, "options-german");
  await page.getByLabel("Sprache").selectOption("en");
  await files("image", "metadata");
});

test("a map is uploaded, watched, and there", async () => {
  await page.getByLabel("Name", { exact: true }).fill("Hall 1");
  await page.getByRole("button", { name: "Upload and analyse" }).click();
  await page.locator("progress").waitFor();
  await page.getByText("Analysed").waitFor();
  await page.getByRole("link", { name: "Hall 1" }).waitFor();
  await page.locator("img.thumbnail").evaluate((image) => image.decode());
  await page.evaluate(() => scrollTo(0, 0));
  await picture(page, "maps");
});

test("a message is uploaded under its name", async () => {
  const side = 40;
  const data = Array.from({ length: side * side }, (_, cell) => (cell < side || cell % side === 0 ? 100 : 0));
  const message = {
    info: { resolution: 0.1, width: side, height: side, origin: { position: { x: 0, y: 0, z: 0 } } },
    data,
  };
  const buffer = Buffer.from(JSON.stringify(message));
  await page.setInputFiles("#files", { name: "grid.json", mimeType: "application/json", buffer });
  await page.getByLabel("Name", { exact: true }).fill("From a robot");
  await page.getByRole("button", { name: "Upload and analyse" }).click();
  await page.getByRole("link", { name: "From a robot" }).waitFor();
});

test("of many jobs that wait, the last is cancelled", async () => {
  const jobs = [];
  for (const number of [2, 3, 4, 5, 6]) jobs.push(await upload(service.base, `Hall ${number}`));
  await page.reload();
  const card = page.locator("li.map").filter({ has: page.getByRole("heading", { name: "Hall 6" }) });
  await card.getByRole("button", { name: "Cancel" }).click();
  await card.getByText("The analysis was cancelled").waitFor();
  for (const { jobID } of jobs.slice(0, -1)) await fetch(`${service.base}/v1/jobs/${jobID}`, { method: "DELETE" });
});

test("a map is deleted after a question", async () => {
  const { body } = await json(service.base, "/v1/maps");
  await page.getByRole("button", { name: "Delete Hall 6" }).click();
  await page.getByRole("dialog").getByRole("button", { name: "Keep" }).click();
  assert.equal((await json(service.base, "/v1/maps")).body.maps.length, body.maps.length);
  await page.getByRole("button", { name: "Delete Hall 6" }).click();
  await page.getByRole("dialog").getByRole("button", { name: "Delete" }).click();
  await page.getByRole("heading", { name: "Hall 6" }).waitFor({ state: "detached" });
  assert.equal((await json(service.base, "/v1/maps")).body.maps.length, body.maps.length - 1);
});

test("a deletion is undone by anybody who looks, as long as the service keeps the map", async () => {
  const { body } = await json(service.base, "/v1/maps");
  const { id } = body.maps.find((map) => map.name === "Hall 5");
  assert.equal((await fetch(`${service.base}/v1/maps/${id}`, { method: "DELETE" })).status, 204);
  const other = await startBrowser();
  await other.page.goto(service.base);
  for (const name of ["Hall 5", "Hall 6"]) {
    await other.page.getByText(`“${name}” was deleted. It can be brought back until`).waitFor();
    await other.page.getByRole("button", { name: `Bring back ${name}` }).click();
    await other.page.getByRole("heading", { name }).waitFor();
  }
  assert.equal(await other.page.getByText("was deleted").count(), 0);
  await other.browser.close();
  await page.reload();
  await page.getByRole("heading", { name: "Hall 6" }).waitFor();
});

test("a map is renamed; where somebody else was faster, their name is told and one's own stays", async () => {
  await page.getByRole("button", { name: "Rename Hall 6" }).click();
  const dialog = page.getByRole("dialog");
  const name = dialog.getByLabel("Name");
  await name.fill("Hall 7");
  const { body } = await json(service.base, "/v1/maps");
  const { id } = body.maps.find((map) => map.name === "Hall 6");
  const headers = { "content-type": "application/json" };
  await json(service.base, `/v1/maps/${id}`, { method: "PATCH", headers, body: JSON.stringify({ name: "Hall 8" }) });
  await dialog.getByRole("button", { name: "Rename" }).click();
  await dialog.getByText("it is called “Hall 8” now").waitFor();
  assert.equal(await name.inputValue(), "Hall 7");
  await name.press("Enter");
  await page.getByRole("heading", { name: "Hall 7" }).waitFor();
});

test("files are dropped on the page", async () => {
  const transfer = await page.evaluateHandle(() => {
    const transfer = new DataTransfer();
    transfer.items.add(new File(["P2\n1 1\n255\n0\n"], "small.pgm"));
    return transfer;
  });
  await page.dispatchEvent(".drop", "drop", { dataTransfer: transfer });
  await page.locator(".chip", { hasText: "small.pgm" }).waitFor();
});

test("a service that is gone loses nothing of what was entered", async () => {
  await page.getByLabel("Name", { exact: true }).fill("Hall 9");
  await page.route("**/v1/maps", (route) => route.abort());
  await files("metadata");
  await page.getByRole("button", { name: "Upload and analyse" }).click();
  await page.locator(".problem", { hasText: "The service does not answer" }).waitFor();
  assert.equal(await page.getByLabel("Name", { exact: true }).inputValue(), "Hall 9");
  assert.equal(await page.locator(".chip").count(), 2);
});

test("the page had nothing to complain about", () => assert.deepEqual(complaints, []));
