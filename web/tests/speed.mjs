/**
 * How fast the map is with ten thousand faces: milliseconds from frame to frame while it is dragged and zoomed, and the
 * time to the first view. Not a test: figures depend on the machine. `STILLAGE_BINARY=... node tests/speed.mjs`
 */

import { openMap, startBrowser, startService, uploadExample } from "./service.mjs";

/** Rows and columns of places. */
const SIDE = 100;

const service = await startService();
const map = await uploadExample(service.base, "Ten thousand faces");
const { browser, page } = await startBrowser();

const square = (column, row) => {
  const [x, y] = [column * 0.45, row * 0.3];
  return [
    [x, y],
    [x + 0.4, y],
    [x + 0.4, y + 0.25],
    [x, y + 0.25],
    [x, y],
  ];
};
const cells = Array.from({ length: SIDE * SIDE }, (_, index) => square(index % SIDE, Math.floor(index / SIDE)));
const collection = (features) => JSON.stringify({ type: "FeatureCollection", features, links: [] });
const faces = cells.map((ring, id) => ({
  type: "Feature",
  id,
  geometry: { type: "Polygon", coordinates: [ring] },
  properties: { id, category: id % 4, label: ["co", "ju", "pc", "ro"][id % 4] },
}));
const edges = cells.flatMap((ring, id) =>
  ring.slice(1, 3).map((end, side) => ({
    type: "Feature",
    id: id * 2 + side,
    geometry: { type: "LineString", coordinates: [ring[side], end] },
    properties: {
      id: id * 2 + side,
      cogency: ["cogent", "storage-access", "invalid"][id % 3],
      faceLeft: id,
      faceRight: null,
    },
  })),
);
const answer = (body) => (route) => route.fulfill({ contentType: "application/geo+json", body });
await page.route("**/collections/faces/items?**", answer(collection(faces)));
await page.route("**/collections/edges/items?**", answer(collection(edges)));

const begin = Date.now();
await openMap(page, service.base, map);
console.log(
  `first view, ${faces.length} faces and ${edges.length} edges: ${Date.now() - begin} ms (half a second of it waits for silence)`,
);

/** Frames while something is done with the mouse. */
async function frames(name, act) {
  await page.evaluate(() => {
    const times = (globalThis.times = []);
    const tick = (now) => {
      times.push(now);
      if (times === globalThis.times) requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  });
  await act();
  const times = await page.evaluate(() => {
    const { times } = globalThis;
    globalThis.times = undefined;
    return times;
  });
  const steps = times
    .slice(1)
    .map((time, index) => time - times[index])
    .sort((left, right) => left - right);
  const at = (share) => steps[Math.floor(steps.length * share)]?.toFixed(0);
  console.log(
    `${name}: median ${at(0.5)} ms, 95 % below ${at(0.95)} ms, longest ${at(0.999)} ms, ${steps.length} frames`,
  );
}

const drag = async () => {
  await page.mouse.move(700, 400);
  await page.mouse.down();
  for (let step = 0; step < 60; step += 1) {
    await page.mouse.move(700 + 150 * Math.sin(step / 6), 400 + 100 * Math.cos(step / 9));
    await page.waitForTimeout(16);
  }
  await page.mouse.up();
};
const zoom = async () => {
  for (let step = 0; step < 12; step += 1) {
    await page.mouse.wheel(0, step < 6 ? -120 : 120);
    await page.waitForTimeout(120);
  }
};
await frames("pan", drag);
await frames("zoom", zoom);
await browser.close();
await service.stop();
