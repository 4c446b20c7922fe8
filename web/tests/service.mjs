/** A service of one's own in a temporary folder, and a browser that looks at it. */

import { spawn } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { createInterface } from "node:readline";

import { chromium } from "playwright-core";

/** The generated warehouse that `stillage demo` shows. */
export const EXAMPLE = {
  image: new URL("../../examples/warehouse.png", import.meta.url),
  metadata: new URL("../../examples/warehouse.yaml", import.meta.url),
  truth: new URL("../../examples/warehouse.truth.geojson", import.meta.url),
};

/** Starts the service; resolves once it listens. */
export async function startService(more = []) {
  const folder = await mkdtemp(join(tmpdir(), "stillage-web-"));
  let program = await run(folder, "127.0.0.1:0", more);
  const end = async () => {
    const ended = new Promise((done) => program.once("exit", done));
    program.kill();
    await ended;
  };
  const service = {
    base: program.base,
    folder,
    /** Ends the service, and keeps what it stored. */
    interrupt: end,
    /** Starts it again at the same address with what it stored. */
    resume: async () => {
      program = await run(folder, new URL(service.base).host, more);
    },
    stop: async () => {
      await end();
      await rm(folder, { recursive: true });
    },
  };
  return service;
}

/** Runs the program on a folder. */
async function run(folder, address, more) {
  const options = ["serve", "--listen", address, "--data", folder, "--log", "warn", ...more];
  const program = spawn(process.env.STILLAGE_BINARY, options, { stdio: ["ignore", "pipe", "inherit"] });
  program.base = await new Promise((listening, failed) => {
    program.once("exit", (code) => failed(new Error(`the service ended with ${code}`)));
    createInterface({ input: program.stdout }).on("line", (line) => {
      const address = line.match(/listening on (\S+)/);
      if (address) listening(address[1]);
    });
  });
  return program;
}

/** JSON from the service. */
export async function json(base, path, wish = {}) {
  const response = await fetch(`${base}${path}`, wish);
  if (!response.ok) throw new Error(`${path}: ${response.status} ${await response.text()}`);
  return { body: await response.json(), tag: response.headers.get("etag") };
}

/** A change of labels by somebody else than the browser. */
export async function changeLabels(base, map, patch) {
  const { tag } = await json(base, `/v1/maps/${map}/semantics`);
  const headers = { "content-type": "application/json", "if-match": tag };
  return json(base, `/v1/maps/${map}/semantics`, { method: "PATCH", headers, body: JSON.stringify(patch) });
}

/** Uploads the example; answers with its job. */
export async function upload(base, name) {
  const form = new FormData();
  form.append("image", new Blob([await readFile(EXAMPLE.image)]), "warehouse.png");
  form.append("metadata", new Blob([await readFile(EXAMPLE.metadata)]), "warehouse.yaml");
  form.append("name", name);
  return (await json(base, "/v1/maps", { method: "POST", body: form })).body;
}

/** Uploads the example and waits until it is analysed; answers with its id. */
export async function uploadExample(base, name) {
  const job = await upload(base, name);
  // The stream of events ends with the job.
  await (await fetch(`${base}/v1/jobs/${job.jobID}/events`)).text();
  return job.mapId;
}

/** A browser without a graphics processor, and what its pages complain about. */
export async function startBrowser(options = {}) {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking", "--disable-component-update"],
  });
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, locale: "en-GB", ...options });
  if (process.env.STILLAGE_PAGE) await showPage(context, resolve(process.env.STILLAGE_PAGE));
  const page = await context.newPage();
  const complaints = [];
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("console", (message) => {
    // A refusal is part of many tests; the browser logs it as a failed resource.
    if (message.type() === "error" && !message.text().startsWith("Failed to load resource"))
      complaints.push(message.text());
  });
  return { browser, page, complaints };
}

/** Shows the page of a folder in the place of the one in the program, under the same policy. */
async function showPage(context, folder) {
  const isDocument = (request) => request.resourceType() === "document";
  await context.route(/^http:\/\/127\.0\.0\.1:\d+\/(#.*)?$/, async (route) => {
    if (!isDocument(route.request())) return route.fallback();
    const response = await route.fetch();
    return route.fulfill({ response, body: await readFile(join(folder, "index.html")) });
  });
  await context.route("**/assets/*", (route) =>
    route.fulfill({ path: join(folder, new URL(route.request().url()).pathname) }),
  );
}

/** Opens a map with a tool and waits until it is drawn. */
export async function openMap(page, base, map, tool = "look") {
  await page.goto(`${base}/#/maps/${map}/${tool}`);
  await page.locator("a[role=tab][aria-selected=true]").waitFor();
  // Once it is drawn, the address tells where the map is looked at.
  await page.waitForFunction((tool) => location.hash.includes(`/${tool}?`) && /[?&]r=\d/.test(location.hash), tool);
  await page.waitForLoadState("networkidle");
}

/** Where a point of the map, metres, lies on the screen. */
export async function onScreen(page, [x, y]) {
  const view = new URLSearchParams(new URL(page.url()).hash.split("?")[1]);
  const box = await page.locator(".canvas").boundingBox();
  const resolution = Number(view.get("r"));
  return [
    box.x + box.width / 2 + (x - Number(view.get("x"))) / resolution,
    box.y + box.height / 2 - (y - Number(view.get("y"))) / resolution,
  ];
}

/** Clicks a point of the map, metres, and lets the time of a double click pass. */
export async function clickMap(page, point) {
  const [x, y] = await onScreen(page, point);
  await page.mouse.click(x, y);
  await page.waitForTimeout(350);
}

/** The pictures of docs/dashboard.md. */
const DOCUMENTED = ["maps", "look", "decide", "correct", "compare", "analyses", "route"];

/** Keeps a picture of the page: for whoever looks at a failed run, and for the documentation where it is asked for. */
export async function picture(page, name) {
  await page.screenshot({ path: new URL(`output/${name}.png`, import.meta.url).pathname });
  if (process.env.UPDATE_PICTURES && DOCUMENTED.includes(name)) {
    await page.screenshot({ path: new URL(`../../docs/dashboard/${name}.png`, import.meta.url).pathname });
  }
}
