/** Maps: the list, upload, deletion. */

import { ask, get, send, type Tagged } from "./request";
import type { DeletedMap, Job, MapView } from "./types";

/** All maps, newest first. */
export function listMaps(): Promise<MapView[]> {
  return everyPage("v1/maps?limit=100");
}

/** The deleted maps that can be brought back, the newest map first. */
export function listDeletedMaps(): Promise<DeletedMap[]> {
  return everyPage("v1/deleted-maps?limit=100");
}

/** The maps of a list, page after page. */
async function everyPage<T>(first: string): Promise<T[]> {
  const maps: T[] = [];
  let path: string | undefined = first;
  while (path !== undefined) {
    const page: { maps: T[]; links: { rel: string; href: string }[] } = await get(path);
    maps.push(...page.maps);
    path = nextPath(page.links);
  }
  return maps;
}

/** The path of the next page, relative to this one's: links are absolute, and a proxy may have another address. */
export function nextPath(links: readonly { rel: string; href: string }[]): string | undefined {
  const next = links.find((link) => link.rel === "next")?.href;
  return next?.slice(next.indexOf("v1/"));
}

/** What is uploaded: a picture with its metadata, or a message. */
export type Upload =
  | { readonly kind: "picture"; readonly image: File; readonly metadata: File }
  | { readonly kind: "message"; readonly message: File };

/** Uploads a map; answers with its job. */
export async function createMap(upload: Upload, name: string, options: unknown): Promise<Job> {
  if (upload.kind === "message") {
    const query = name ? `?${new URLSearchParams({ name })}` : "";
    const isYaml = /\.ya?ml$/i.test(upload.message.name);
    const headers = { "Content-Type": isYaml ? "application/yaml" : "application/json" };
    return json(await ask(`v1/maps${query}`, { method: "POST", body: upload.message, headers }));
  }
  const form = new FormData();
  form.append("image", upload.image);
  form.append("metadata", upload.metadata);
  if (name) form.append("name", name);
  if (options) form.append("options", JSON.stringify(options));
  return json(await ask("v1/maps", { method: "POST", body: form }));
}

async function json(response: Response): Promise<Job> {
  return (await response.json()) as Job;
}

export async function deleteMap(id: string): Promise<void> {
  await ask(`v1/maps/${id}`, { method: "DELETE" });
}

/** Another name, where nobody changed the map since it was read with this tag. */
export function renameMap(id: string, name: string, tag: string): Promise<Tagged<MapView>> {
  return send("PATCH", `v1/maps/${id}`, { name }, tag);
}

/** Brings a deleted map back. */
export async function restoreMap(id: string): Promise<void> {
  await ask(`v1/maps/${id}/restore`, { method: "POST" });
}
