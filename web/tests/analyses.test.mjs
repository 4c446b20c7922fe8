/** Analysing again: other options, a proposal, what it would change, and what would be lost. */

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { changeLabels, json, openMap, picture, startBrowser, startService, uploadExample } from "./service.mjs";

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

const analyses = async () => (await json(service.base, `/v1/maps/${map}/analyses`)).body.analyses;
/** The field of an option. */
const option = (path) => page.locator(".field").filter({ hasText: `(${path})` });
const card = (text) => page.locator(".analyses > li").filter({ hasText: text });

test("the form has the options of the analysis in force, and an option out of its range is refused", async () => {
  await openMap(page, service.base, map, "analyses");
  await card("in force").waitFor();
  await page.locator("summary", { hasText: "Options of the analysis" }).click();
  const seed = page.getByLabel("Seed", { exact: true });
  await seed.waitFor();
  assert.equal(await seed.inputValue(), "");
  const bins = page.getByLabel("Bins", { exact: true });
  await bins.fill("5");
  await page.evaluate(() => (document.querySelector(".panel form").noValidate = true));
  await page.getByRole("button", { name: "Analyse again" }).click();
  await page.locator(".problem code", { hasText: "/orientation/bins" }).waitFor();
  await bins.fill("");
});

test("another analysis is a proposal that nobody else sees", async () => {
  await option("decomposition/method").locator("select").selectOption("paper");
  await page.getByRole("button", { name: "Analyse again" }).click();
  await page.locator("progress").waitFor();
  const proposal = card("This is the result");
  await proposal.getByText("Method (decomposition/method): adaptive → paper").waitFor();
  const [made, first] = await analyses();
  assert.deepEqual([made.inForce, first.inForce], [false, true]);
  assert.equal(made.options.decomposition.method, "paper");
  await page.waitForTimeout(300);
  await picture(page, "analyses");
});

test("options that were analysed before answer at once", async () => {
  await page.getByRole("button", { name: "Analyse again" }).click();
  await card("This is the result").waitFor();
  assert.equal((await analyses()).length, 2);
});

test("the form begins with the options of any analysis, or with the defaults", async () => {
  const begin = page.getByLabel("Begin with the options of");
  const [made] = await analyses();
  const method = option("decomposition/method").locator("select");
  await begin.selectOption({ label: "none: all defaults" });
  await page.waitForFunction(
    () => ![...document.querySelectorAll(".options select")].some(({ value }) => value === "paper"),
  );
  assert.equal(await method.inputValue(), "");
  await begin.selectOption(made.id);
  await page.waitForFunction(() =>
    [...document.querySelectorAll(".options select")].some((select) => select.value === "paper"),
  );
  assert.equal(await method.inputValue(), "paper");
});

test("a proposal is compared, its losses are told before it is put in force, and the way leads back", async () => {
  const { body } = await json(service.base, `/v1/maps/${map}/collections/faces/items?label=pc&limit=3`);
  await changeLabels(service.base, map, {
    overrides: Object.fromEntries(body.features.map(({ id }) => [id, "ro"])),
  });
  const [made, first] = await analyses();
  const prospect = (await json(service.base, `/v1/maps/${map}/analyses/${made.id}`)).body.wouldCarry;
  assert.equal(prospect.kept + prospect.lost.length, 3);
  await openMap(page, service.base, map, "look");
  await openMap(page, service.base, map, "analyses");
  await card("paper").getByRole("link", { name: "Compare with what is in force" }).click();
  await page.getByText(`${prospect.kept} would be kept, ${prospect.lost.length} lost`).waitFor();
  await page.getByRole("tab", { name: "Analyses" }).click();
  await card("paper").getByRole("button", { name: "Put in force" }).click();
  const dialog = page.getByRole("dialog");
  await dialog
    .getByText(prospect.lost.length > 0 ? "find no ground there" : "All labels that people gave are kept")
    .waitFor();
  await dialog.getByRole("button", { name: "Put in force" }).click();
  await page.getByText("The other analysis is in force now").waitFor();
  assert.equal((await analyses()).find((one) => one.inForce).id, made.id);
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByText("The other analysis is in force now").waitFor({ state: "detached" });
  assert.equal((await analyses()).find((one) => one.inForce).id, first.id);
  const { body: semantics } = await json(service.base, `/v1/maps/${map}/semantics`);
  assert.equal(semantics.overrides.length, 3, "the labels are as they were");
});

test("the page had nothing to complain about", () => assert.deepEqual(complaints, []));
