/** A refusal, whole: what happened, what is wrong, where, and how to mend it. */

import { h, replace } from "../dom";
import { t } from "../language";
import { Refused } from "../service/request";

/** The box for what went wrong on a page; screen readers are told when it fills. */
export function problemBox(): HTMLElement {
  return h("div", { class: "problems", role: "alert" });
}

/** Shows an error in a box. */
export function show(box: HTMLElement, error: unknown): void {
  replace(box, error instanceof Refused ? refusal(error) : h("div", { class: "problem" }, h("p", {}, String(error))));
}

export function clear(box: HTMLElement): void {
  replace(box);
}

function refusal({ problem }: Refused): HTMLElement {
  if (problem.status === 0) {
    return h("div", { class: "problem" }, h("strong", {}, t("unreachable")), h("p", {}, t("unreachableMeaning")));
  }
  const items = (problem.errors ?? []).map((item) => {
    const place = item.pointer ?? item.parameter;
    return h("li", {}, place && h("code", {}, place), place && ": ", item.detail);
  });
  const isRepeated = problem.errors?.length === 1 && problem.errors[0]?.detail === problem.detail;
  return h(
    "div",
    { class: "problem" },
    h("strong", {}, problem.title),
    !isRepeated && h("p", {}, problem.detail),
    items.length > 0 && h("ul", {}, ...items),
    h("small", {}, `${problem.status} `, problem.type.startsWith("/problems/") && help(problem.type)),
  );
}

function help(type: string): HTMLElement {
  return h("a", { href: `.${type}?f=html`, target: "_blank", rel: "noopener" }, t("aboutProblem"));
}
