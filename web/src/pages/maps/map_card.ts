/** A map in the list: picture, name, state, and what can be done with it. */

import { ofMap } from "../../address";
import { button, h } from "../../dom";
import { moment, number, t } from "../../language";
import { confirm } from "../../parts/confirm";
import { rename } from "../../parts/rename";
import { jobProgress, type JobEvents } from "../../parts/job_progress";
import { isOver } from "../../service/jobs";
import { deleteMap } from "../../service/maps";
import type { Job, MapView } from "../../service/types";

/** Cells up to which a browser draws the whole picture as a small one without effort. */
const THUMBNAIL_CELLS = 16_000_000;

/** The latest job of a map, and whether it is followed. */
export interface CardJob {
  readonly job: Job | undefined;
  readonly isWatched: boolean;
}

export function mapCard(map: MapView, job: CardJob, events: JobEvents): HTMLElement {
  const isAnalysed = Boolean(map.analysisId);
  const remove = async (): Promise<void> => {
    if (!(await confirm(t("deleteQuestion", { name: map.name }), t("deleteMeaning"), t("delete")))) return;
    await deleteMap(map.id);
    events.changed();
  };
  const name = isAnalysed ? h("a", { href: ofMap(map.id) }, map.name) : map.name;
  return h(
    "li",
    { class: "card map" },
    isAnalysed ? h("a", { href: ofMap(map.id), tabindex: -1, "aria-hidden": "true" }, thumbnail(map)) : thumbnail(map),
    h(
      "div",
      { class: "about" },
      h("h2", {}, name),
      h("p", {}, size(map), " · ", moment(map.created)),
      ...map.warnings.map((warning) => h("p", { class: "warning" }, warning.message)),
      state(map, job, events),
    ),
    h(
      "div",
      { class: "line" },
      button(t("rename"), () => void rename(map.id, events.changed).catch(events.failed), {
        "aria-label": t("renameOne", { name: map.name }),
      }),
      button(t("delete"), () => void remove().catch(events.failed), {
        "aria-label": t("deleteOne", { name: map.name }),
      }),
    ),
  );
}

function size(map: MapView): string {
  const [width, height] = [map.width * map.resolutionM, map.height * map.resolutionM];
  return t("size", { width: number(width, 1), height: number(height, 1), cell: number(map.resolutionM, 3) });
}

function thumbnail(map: MapView): HTMLElement {
  if (map.width * map.height > THUMBNAIL_CELLS) return h("div", { class: "thumbnail" });
  const picture = map.analysisId ? "semantic.png" : "image.png";
  const src = `v1/maps/${map.id}/${picture}`;
  return h("img", { class: "thumbnail", src, alt: "", loading: "lazy", width: 160, height: 100 });
}

function state(map: MapView, { job, isWatched }: CardJob, events: JobEvents): HTMLElement {
  if (job && !isOver(job)) return jobProgress(job, isWatched, events);
  if (job?.status === "failed") return h("p", { class: "bad" }, `${t("failed")} ${job.message}`);
  if (map.analysisId) return h("p", { class: "good" }, t("analysed"));
  return h("p", { class: "bad" }, job?.status === "dismissed" ? t("dismissed") : t("notAnalysed"));
}
