/** Whether the service answers. Once it does not, it is asked every other second until it does again. */

/** Milliseconds between two questions. */
const PAUSE_MS = 2_000;

type Listener = (isGone: boolean) => void;

const listeners = new Set<Listener>();
let isGone = false;

/** Tells when the service is gone and when it is back. Returns how to stop. */
export function onConnection(listener: Listener): () => void {
  listeners.add(listener);
  return () => void listeners.delete(listener);
}

/** A request found nobody. */
export function foundNobody(): void {
  if (isGone) return;
  change(true);
  const asking = setInterval(() => {
    fetch("health/live").then(({ ok }) => {
      if (!ok || !isGone) return;
      clearInterval(asking);
      change(false);
    }, nothing);
  }, PAUSE_MS);
}

function nothing(): void {
  // It is asked again after the pause.
}

function change(now: boolean): void {
  isGone = now;
  for (const listener of listeners) listener(now);
}
