/** A job as it runs: its stage, how far it is, and a button that ends it. */

import { button, h, replace } from "../dom";
import { t } from "../language";
import { dismiss, isOver, watch } from "../service/jobs";
import type { Job } from "../service/types";

/** Follows a job; tells once when it is over. */
export function jobProgress(job: Job, over: (job: Job) => void, failed: (error: unknown) => void): HTMLElement {
  const bar = h("progress", { max: 100, "aria-label": t("progress") });
  const stage = h("span", { role: "status" });
  const seconds = h("small", {});
  const cancel = button(t("cancel"), () => {
    cancel.disabled = true;
    dismiss(job.jobID).catch(failed);
  });
  const show = (now: Job): void => {
    bar.value = now.progress;
    replace(stage, now.status === "accepted" ? t("waiting") : t("stage", { name: now.stage ?? "" }));
    replace(seconds, now.stages.map((done) => `${done.name} ${done.wallS.toFixed(1)} s`).join(" · "));
  };
  show(job);
  const stop = watch(job.jobID, (now) => {
    show(now);
    if (isOver(now)) over(now);
    else if (!bar.isConnected) stop();
  });
  return h("div", { class: "job" }, h("div", { class: "line" }, bar, stage, cancel), seconds);
}
