/** A service that needs keys: somebody signs in, looks, and signs out. */

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { test } from "node:test";
import { promisify } from "node:util";

import { startBrowser, startService } from "./service.mjs";

test("whoever has a key signs in and sees the maps", async (t) => {
  const service = await startService(["--keys", "required"]);
  t.after(() => service.stop());
  const create = ["key", "create", "--data", service.folder, "--tenant", "local", "--scopes", "read,write"];
  const { stdout } = await promisify(execFile)(process.env.STILLAGE_BINARY, create);
  const { browser, page, complaints } = await startBrowser();
  t.after(() => browser.close());
  await page.goto(service.base);
  const dialog = page.getByRole("dialog");
  await dialog.getByLabel("Key").fill("stillage_wrong");
  await dialog.getByRole("button", { name: "Sign in" }).click();
  await dialog.getByText("this key is not known here").waitFor();
  await dialog.getByLabel("Key").fill(stdout.trim());
  await dialog.getByRole("button", { name: "Sign in" }).click();
  await page.getByRole("button", { name: "Sign out" }).waitFor();
  assert.equal(await dialog.count(), 0);
  await page.reload();
  await page.getByRole("heading", { name: "Maps" }).waitFor();
  assert.equal(await page.getByRole("dialog").count(), 0, "the session outlives the page");
  await page.getByRole("button", { name: "Sign out" }).click();
  await page.getByRole("dialog").getByLabel("Key").waitFor();
  assert.deepEqual(complaints, []);
});
