/** Every page for every person: axe-core, keyboard, dark, German, a tablet. */

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { after, before, test } from "node:test";

import { changeLabels, openMap, picture, startBrowser, startService, uploadExample } from "./service.mjs";

const axe = await readFile(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
let service;
let map;

before(async () => {
  service = await startService();
  map = await uploadExample(service.base, "Hall 1");
  await changeLabels(service.base, map, { assignment: { 0: "ro" } });
});
after(() => service?.stop());

/** What axe-core finds on a page, one line for each violation. */
async function violations(page) {
  // The policy of the page lets no script in: the checker comes by the protocol of the browser.
  await page.evaluate(`${axe}; undefined`);
  const found = await page.evaluate(() => globalThis.axe.run(document));
  return found.violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(" ")).join(", ")}`);
}

const PAGES = {
  maps: (page) => page.goto(`${service.base}/#/`).then(() => page.locator("li.map").waitFor()),
  look: (page) => openMap(page, service.base, map, "look"),
  decide: (page) => openMap(page, service.base, map, "decide").then(() => page.locator(".category").first().waitFor()),
  rules: async (page) => {
    await PAGES.decide(page);
    await page.getByRole("button", { name: /Edit labels|Labels und Regeln/ }).click();
    await page.getByRole("dialog").waitFor();
  },
  correct: async (page) => {
    await openMap(page, service.base, map, "correct");
    await page.getByRole("toolbar").getByRole("button", { name: "Label" }).click();
    const { x, y, width, height } = await page.locator(".canvas").boundingBox();
    await page.mouse.click(x + width / 3, y + height / 2);
    await page.locator(".correction-form").waitFor();
    await page.locator(".bar p").first().waitFor();
  },
  compare: async (page) => {
    await openMap(page, service.base, map, "compare");
    await page.locator("option", { hasText: "Version 0" }).waitFor({ state: "attached" });
    await page.getByRole("combobox", { name: /Compare with|Vergleichen mit/ }).selectOption("version 0");
    await page.locator(".swipe").waitFor();
  },
  analyses: async (page) => {
    await openMap(page, service.base, map, "analyses");
    await page.locator(".analyses > li").waitFor();
  },
  routes: (page) => openMap(page, service.base, map, "routes"),
  "hand-over": (page) =>
    openMap(page, service.base, map, "hand-over").then(() => page.locator("tbody tr").first().waitFor()),
};

for (const [name, options] of Object.entries({
  light: {},
  "dark, German": { colorScheme: "dark", locale: "de-DE" },
  "on a tablet": { viewport: { width: 768, height: 1024 }, hasTouch: true },
})) {
  test(`no page has a violation: ${name}`, async () => {
    const { browser, page, complaints } = await startBrowser(options);
    const found = {};
    for (const [place, open] of Object.entries(PAGES)) {
      await open(page);
      await page
        .locator("details:not([open]) > summary")
        .evaluateAll((all) => all.slice(0, 3).forEach((one) => one.click()));
      found[place] = await violations(page);
      const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      if (overflow > 0) found[place].push(`${overflow} pixels too wide`);
      if (name !== "light" && place === "decide") await picture(page, name === "on a tablet" ? "tablet" : "dark");
      await page.keyboard.press("Escape");
    }
    await browser.close();
    assert.deepEqual(found, Object.fromEntries(Object.keys(PAGES).map((place) => [place, []])));
    assert.deepEqual(complaints, []);
  });
}

test("everything is reached by keys: a map is opened, a place is found", async () => {
  const { browser, page } = await startBrowser();
  await page.goto(service.base);
  const link = page.getByRole("link", { name: "Hall 1" });
  await link.waitFor();
  for (let tabs = 0; tabs < 20 && !(await link.evaluate((one) => one === document.activeElement)); tabs += 1)
    await page.keyboard.press("Tab");
  await page.keyboard.press("Enter");
  const search = page.getByLabel("Search a code or a name");
  await search.waitFor();
  await search.focus();
  await page.keyboard.type("corridor");
  await page.locator(".answers button").first().waitFor();
  await page.keyboard.press("Enter");
  await page.getByRole("complementary", { name: "Properties" }).getByText("corridor").first().waitFor();
  await browser.close();
});
