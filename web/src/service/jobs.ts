/** Jobs: the latest of each map, and the events of one. */

import { ask, get } from "./request";
import type { Job } from "./types";

export function isOver(job: Job): boolean {
  return !["accepted", "running"].includes(job.status);
}

/** The latest job of each map, among the last hundred. */
export async function latestJobs(): Promise<Map<string, Job>> {
  const { jobs } = await get<{ jobs: Job[] }>("v1/jobs?limit=100");
  const latest = new Map<string, Job>();
  for (const job of jobs) {
    const known = latest.get(job.mapId);
    if (!known || known.created < job.created) latest.set(job.mapId, job);
  }
  return latest;
}

/**
 * Streams of events at the same time. A browser opens six connections to a host over HTTP/1.1, and all other requests need
 * one, too.
 */
const MOST_STREAMS = 3;

/** Ids of the jobs that are followed: those that came first and are not over. The list is read anew when one ends. */
export function watchedJobs(jobs: readonly Job[]): ReadonlySet<string> {
  const unfinished = jobs
    .filter((job) => !isOver(job))
    .sort((left, right) => left.created.localeCompare(right.created));
  return new Set(unfinished.slice(0, MOST_STREAMS).map((job) => job.jobID));
}

/** Tells every change of a job up to its end; the browser connects again by itself. Returns how to stop. */
export function watch(id: string, tell: (job: Job) => void): () => void {
  const events = new EventSource(`v1/jobs/${id}/events`);
  events.addEventListener("progress", (event: MessageEvent<string>) => {
    const job = JSON.parse(event.data) as Job;
    if (isOver(job)) events.close();
    tell(job);
  });
  return () => events.close();
}

export async function dismiss(id: string): Promise<void> {
  await ask(`v1/jobs/${id}`, { method: "DELETE" });
}
