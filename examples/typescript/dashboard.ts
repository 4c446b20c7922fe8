// A dashboard: uploads a map, shows how its analysis proceeds, counts faces by label, and decides about a category.
//
//     node build/dashboard.js http://127.0.0.1:8080 IMAGE METADATA

import { readFile } from "node:fs/promises";
import { basename, extname } from "node:path";
import { ask, read } from "./ask.js";

interface Job {
  status: "accepted" | "running" | "successful" | "failed" | "dismissed";
  progress: number;
  message: string;
  stage?: string;
  mapId: string;
}

interface Category {
  id: number;
  kind: string;
  label: string;
  areaM2: number;
}

/** The states of a job as they come, up to the final one: server-sent events. */
async function* progress(jobUrl: string): AsyncGenerator<Job> {
  const events = await ask(`${jobUrl}/events`);
  let text = "";
  for await (const part of events.body!.pipeThrough(new TextDecoderStream())) {
    const lines = (text + part).split("\n");
    text = lines.pop()!;
    for (const line of lines) {
      if (line.startsWith("data:")) yield JSON.parse(line.slice("data:".length)) as Job;
    }
  }
}

/** How many faces each label has, in a line. */
async function facesByLabel(mapUrl: string): Promise<string> {
  const { features } = await read<{ features: { properties: { labelName: string } }[] }>(
    `${mapUrl}/collections/faces/items?limit=10000`,
  );
  const counts = new Map<string, number>();
  for (const { properties } of features) counts.set(properties.labelName, (counts.get(properties.labelName) ?? 0) + 1);
  return [...counts].map(([label, count]) => `${count} ${label}`).join(", ");
}

const [service, image, metadata] = process.argv.slice(2);

const form = new FormData();
form.set("image", new Blob([await readFile(image!)]), basename(image!));
form.set("metadata", new Blob([await readFile(metadata!)]), basename(metadata!));
form.set("name", basename(image!, extname(image!)));
const upload = await ask(`${service}/v1/maps`, { method: "POST", body: form });
let job: Job | undefined;
for await (job of progress(`${service}${upload.headers.get("Location")}`)) {
  console.log(`${job.progress} % ${job.status} ${job.stage ?? ""}`);
}
if (job?.status !== "successful") throw new Error(job?.message ?? "the events ended early");
const mapUrl = `${service}/v1/maps/${job.mapId}`;
console.log(await facesByLabel(mapUrl));

// A person decides: the largest category that no label fits is a corridor. If somebody else changed the labels since they
// were read, If-Match has the change refused (412).
const { categories } = await read<{ categories: Category[] }>(`${mapUrl}/categories`);
const open = categories.filter((category) => category.kind === "cluster" && category.label === "un");
const chosen = open.reduce((largest, category) => (category.areaM2 > largest.areaM2 ? category : largest));
const before = await ask(`${mapUrl}/semantics`);
const after = await ask(`${mapUrl}/semantics`, {
  method: "PATCH",
  body: JSON.stringify({ assignment: { [chosen.id]: "co" } }),
  headers: { "If-Match": before.headers.get("ETag")!, "Content-Type": "application/merge-patch+json" },
});
const { version } = (await after.json()) as { version: number };
console.log(`Category ${chosen.id} is a corridor in version ${version} of the labels`);
console.log(await facesByLabel(mapUrl));
