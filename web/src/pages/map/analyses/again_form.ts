/** The form that analyses the map again with other options, and the job while it runs. */

import { choice, field, h, replace } from "../../../dom";
import { moment, t } from "../../../language";
import { jobProgress } from "../../../parts/job_progress";
import { optionsForm } from "../../../parts/options_form";
import { clear, problemBox, show } from "../../../parts/problem";
import { isOver, latestJobs } from "../../../service/jobs";
import { optionDocument } from "../../../service/options";
import { ask, get } from "../../../service/request";
import type { Analysis, Job } from "../../../service/types";
import type { Workspace } from "../workspace";

/** Begins with the options of no analysis. */
const DEFAULTS = "";

export interface AgainForm {
  readonly element: HTMLElement;
  /** Offers the options of these analyses to begin with: at first those of the one in force. */
  offer(analyses: readonly Analysis[]): void;
  close(): void;
}

/** The form; tells the analysis that was made, or nothing where the job came to nothing. */
export function againForm({ map, failed }: Workspace, made: (id?: string) => Promise<void>): AgainForm {
  const problems = problemBox();
  const running = h("div", {});
  const begin = h("div", {});
  const options = optionsForm();
  const submit = h("button", { type: "submit", class: "primary" }, t("analyseAgain"));
  const following: (() => void)[] = [];
  let isOffered = false;

  function offer(analyses: readonly Analysis[]): void {
    const inForce = analyses.find((one) => one.inForce);
    const names = analyses.map((one) => {
      const name = t("analysisOf", { moment: moment(one.created) });
      return [one.id, one.inForce ? `${name} (${t("isInForce")})` : name] as const;
    });
    const take = (id: string): void => void options.fill(analyses.find((one) => one.id === id)?.options);
    const select = choice([...names, [DEFAULTS, t("allDefaults")]], inForce?.id ?? DEFAULTS, take);
    replace(begin, field(t("beginWith"), select));
    // What a person has changed already stays.
    if (!isOffered) take(inForce?.id ?? DEFAULTS);
    isOffered = true;
  }

  async function send(): Promise<void> {
    clear(problems);
    submit.disabled = true;
    try {
      const json = optionDocument(options.chosen()) ?? {};
      const response = await ask(`v1/maps/${map.id}/analyses`, { method: "POST", json });
      const body = (await response.json()) as Job | Analysis;
      if ("jobID" in body) follow(body);
      else await made(body.id);
    } catch (error) {
      show(problems, error);
    } finally {
      submit.disabled = false;
    }
  }

  function follow(job: Job): void {
    const changed = (): void => void over(job.jobID).catch(failed);
    replace(running, jobProgress(job, true, { changed, failed, following: (stop) => void following.push(stop) }));
  }

  /** What became of a job. */
  async function over(id: string): Promise<void> {
    const job = await get<Job>(`v1/jobs/${id}`);
    replace(running);
    if (job.status === "failed") {
      replace(running, h("p", { class: "bad", role: "alert" }, `${t("failed")} ${job.message}`));
    } else if (job.status === "dismissed") replace(running, h("p", { role: "status" }, t("dismissed")));
    await made(job.status === "successful" ? (await newest())?.id : undefined);
  }

  async function newest(): Promise<Analysis | undefined> {
    const { analyses } = await get<{ analyses: Analysis[] }>(`v1/maps/${map.id}/analyses`);
    return analyses[0];
  }

  // A job that was begun before goes on here.
  latestJobs().then((jobs) => {
    const job = jobs.get(map.id);
    if (job && !isOver(job)) follow(job);
  }, failed);
  const element = h(
    "form",
    {
      "aria-labelledby": "again-title",
      onsubmit: (event: Event) => {
        event.preventDefault();
        void send();
      },
    },
    h("h2", { id: "again-title" }, t("analyseAgain")),
    h("p", {}, h("small", {}, t("againMeaning"))),
    begin,
    options.element,
    problems,
    running,
    h("div", { class: "actions" }, submit),
  );
  return {
    element,
    offer,
    close: () => {
      for (const stop of following) stop();
    },
  };
}
