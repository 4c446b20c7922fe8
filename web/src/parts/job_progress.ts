/** A job as it runs: its stage, how far it is, and a button that ends it. */

import { button, h, replace } from "../dom";
import { t } from "../language";
import { dismiss, isOver, watch } from "../service/jobs";
import type { Job } from "../service/types";

export interface JobEvents {
  /** The job is over, or what it is about is another. */
  readonly changed: () => void;
  readonly failed: (error: unknown) => void;
  /** The job is followed until this is called. */
  readonly following: (stop: () => void) => void;
}

/** Shows a job, and follows it where it is watched. */
export function jobProgress(job: Job, isWatched: boolean, { changed, failed, following }: JobEvents): HTMLElement {
  const bar = h("progress", { max: 100, "aria-label": t("progress") });
  const stage = h("span", { role: "status" });
  const seconds = h("small", {});
  const cancel = button(t("cancel"), () => {
    cancel.disabled = true;
    dismiss(job.jobID).then(() => isWatched || changed(), failed);
  });
  const show = (now: Job): void => {
    bar.value = now.progress;
    replace(stage, now.status === "accepted" ? t("waiting") : t("stage", { name: now.stage ?? "" }));
    replace(seconds, now.stages.map((done) => `${done.name} ${done.wallS.toFixed(1)} s`).join(" · "));
  };
  show(job);
  const told = (now: Job): void => {
    show(now);
    if (isOver(now)) changed();
  };
  if (isWatched) following(watch(job.jobID, told));
  return h("div", { class: "job" }, h("div", { class: "line" }, bar, stage, cancel), seconds);
}
