/** Halls that tests make: messages of an occupancy grid. */

import { json } from "./service.mjs";

/** Metres of a cell. */
const CELL = 0.1;
const [WIDTH, HEIGHT] = [360, 240];

/** Walls in the hall, cells: two aisles that nobody enters, and one with a narrow place that is shut at its end. */
export const WALLS = [
  { x: [60, 62], y: [0, 50] },
  { x: [298, 300], y: [0, 50] },
  { x: [60, 62], y: [70, 110] },
  { x: [298, 300], y: [70, 110] },
  { x: [298, 300], y: [130, 170] },
  { x: [180, 184], y: [130, 161] },
];

/** A hall that looks the same turned by half a turn: which way a second scan lies on the first is in doubt. */
export function symmetricHall(walls = []) {
  const isRack = (x, y) => x >= 60 && x < 300 && [50, 110, 170].some((row) => y >= row && y < row + 20);
  const isWall = (x, y) => x < 2 || y < 2 || x >= WIDTH - 2 || y >= HEIGHT - 2;
  const isUpright = (x, y) => isRack(x, y) && ((x - 60) % 12 < 2 || (x - 60) % 12 === 11);
  const cell = (index) => {
    const [x, y] = [index % WIDTH, Math.floor(index / WIDTH)];
    const [left, up] = [x, y];
    const isMore = walls.some(({ x, y }) => left >= x[0] && left < x[1] && up >= y[0] && up < y[1]);
    return isMore || isWall(x, y) || isUpright(x, y) || isUpright(WIDTH - 1 - x, HEIGHT - 1 - y) ? 100 : 0;
  };
  const origin = { position: { x: 0, y: 0, z: 0 } };
  return {
    info: { resolution: CELL, width: WIDTH, height: HEIGHT, origin },
    data: Array.from({ length: WIDTH * HEIGHT }, (_, index) => cell(index)),
  };
}

/** Uploads a message and waits until it is analysed; answers with its id. */
export async function uploadMessage(base, query, message) {
  const headers = { "content-type": "application/json" };
  const wish = { method: "POST", headers, body: JSON.stringify(message) };
  const { body } = await json(base, `/v1/maps?${new URLSearchParams(query)}`, wish);
  await (await fetch(`${base}/v1/jobs/${body.jobID}/events`)).text();
  return body.mapId;
}
