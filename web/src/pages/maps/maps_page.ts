/** The maps of the service: the list, the form for a new one. */

import { h, replace } from "../../dom";
import { t } from "../../language";
import type { Page } from "../page";
import { clear, problemBox, show } from "../../parts/problem";
import { latestJobs } from "../../service/jobs";
import { listMaps } from "../../service/maps";
import { mapCard } from "./map_card";
import { uploadForm } from "./upload";

export function mapsPage(): Page {
  const problems = problemBox();
  const list = h("ul", { class: "maps" });
  let isLeft = false;
  const failed = (error: unknown): void => show(problems, error);

  async function read(): Promise<void> {
    const [maps, jobs] = await Promise.all([listMaps(), latestJobs()]);
    if (isLeft) return;
    clear(problems);
    const events = { changed: () => void read().catch(failed), failed };
    if (maps.length === 0) replace(list, h("li", { class: "empty" }, t("noMaps")));
    else replace(list, ...maps.map((map) => mapCard(map, jobs.get(map.id), events)));
  }

  void read().catch(failed);
  document.title = `${t("maps")} · stillage`;
  const element = h(
    "div",
    { class: "page" },
    h("h1", {}, t("maps")),
    problems,
    h("div", { class: "columns" }, list, uploadForm(() => void read().catch(failed))),
    h("p", {}, h("a", { href: "assets/licenses.txt" }, h("small", {}, t("licenses")))),
  );
  return { element, leave: () => void (isLeft = true) };
}
