/** The maps of the service: the list, the form for a new one. */

import { h, replace } from "../../dom";
import { t } from "../../language";
import type { Page } from "../page";
import { clear, problemBox, show } from "../../parts/problem";
import { onConnection } from "../../service/connection";
import { latestJobs, watchedJobs } from "../../service/jobs";
import { listMaps } from "../../service/maps";
import type { MapView } from "../../service/types";
import { deletedMaps } from "./deleted_maps";
import { mapCard } from "./map_card";
import { uploadForm } from "./upload";

export function mapsPage(): Page {
  const problems = problemBox();
  const list = h("ul", { class: "maps" });
  const following: (() => void)[] = [];
  let isLeft = false;
  const failed = (error: unknown): void => show(problems, error);

  const deleted = deletedMaps(() => void read().catch(failed), failed);

  function stopFollowing(): void {
    for (const stop of following.splice(0)) stop();
  }

  async function read(): Promise<void> {
    const [maps, jobs] = await Promise.all([listMaps(), latestJobs(), deleted.read()]);
    if (isLeft) return;
    clear(problems);
    stopFollowing();
    const events = {
      changed: () => void read().catch(failed),
      failed,
      following: (stop: () => void) => void following.push(stop),
    };
    const watched = watchedJobs([...jobs.values()]);
    const card = (map: MapView): HTMLElement => {
      const job = jobs.get(map.id);
      return mapCard(map, { job, isWatched: job !== undefined && watched.has(job.jobID) }, events);
    };
    if (maps.length === 0) replace(list, h("li", { class: "empty" }, t("noMaps")));
    else replace(list, ...maps.map(card));
  }

  const begin = (): void => void read().catch(failed);
  const stopWaiting = onConnection((isGone) => !isGone && begin());
  begin();
  document.title = `${t("maps")} · stillage`;
  const element = h(
    "div",
    { class: "page" },
    h("h1", {}, t("maps")),
    problems,
    h(
      "div",
      { class: "columns" },
      h("div", {}, deleted.element, list),
      uploadForm(() => void read().catch(failed)),
    ),
    h("p", {}, h("a", { href: "assets/licenses.txt" }, h("small", {}, t("licenses")))),
  );
  const leave = (): void => {
    isLeft = true;
    stopWaiting();
    stopFollowing();
  };
  return { element, leave };
}
