/** A rule set while it is edited. */

import type { Cogency, CogencyMatrix, CogencyRule, Functionality, Label, RuleSet } from "../service/types";

export const FUNCTIONALITIES: readonly Functionality[] = [
  "drivable",
  "storage-access",
  "connection",
  "access",
  "storage",
  "work-place",
];
export const COGENCIES: readonly Cogency[] = ["cogent", "storage-access", "invalid"];

export interface RuleSetDraft {
  readonly id: string;
  readonly labels: readonly Label[];
  readonly cogency: readonly CogencyRule[];
}

/** A draft of a rule set; a built-in one is copied under a new id. */
export function draftOf(ruleSet: RuleSet): RuleSetDraft {
  const id = ruleSet.builtIn ? `${ruleSet.id}-copy` : ruleSet.id;
  return { id, labels: ruleSet.labels, cogency: ruleSet.cogency ?? [] };
}

export function withLabel(draft: RuleSetDraft, index: number, change: Partial<Label>): RuleSetDraft {
  return { ...draft, labels: draft.labels.map((label, at) => (at === index ? { ...label, ...change } : label)) };
}

/** Puts a value into a list, or takes it out. */
export function toggled<T>(list: readonly T[] | undefined, value: T, isIn: boolean): T[] {
  const others = (list ?? []).filter((one) => one !== value);
  return isIn ? [...others, value] : others;
}

/** What an edge between two labels means: the first rule that names them, else what follows from the labels. */
export function cogencyOf(
  draft: RuleSetDraft,
  derived: CogencyMatrix,
  left: string,
  right: string,
): Cogency | undefined {
  const rule = draft.cogency.find(({ when }) => fits(when, left, right));
  if (rule) return rule.then;
  const [row, column] = [left, right].map((id) => derived.labels.findIndex((label) => label.id === id));
  return derived.cogency[row ?? -1]?.[column ?? -1];
}

function fits([first = "", second = ""]: readonly string[], left: string, right: string): boolean {
  const one = (wanted: string, label: string): boolean => wanted === "*" || wanted === label;
  return (one(first, left) && one(second, right)) || (one(first, right) && one(second, left));
}

/** The rule for exactly these two labels comes first; no value takes it away. */
export function withCogency(
  draft: RuleSetDraft,
  left: string,
  right: string,
  value: Cogency | undefined,
): RuleSetDraft {
  const isSame = ({ when }: CogencyRule): boolean => [...when].sort().join() === [left, right].sort().join();
  const others = draft.cogency.filter((rule) => !isSame(rule));
  return { ...draft, cogency: value === undefined ? others : [{ when: [left, right], then: value }, ...others] };
}

/** The document that the service reads. */
export interface RuleSetDocument {
  readonly id: string;
  readonly labels: readonly Label[];
  readonly cogency?: readonly CogencyRule[];
}

export function documentOf({ id, labels, cogency }: RuleSetDraft): RuleSetDocument {
  return { id, labels, ...(cogency.length > 0 ? { cogency } : {}) };
}

/** The document as a draft again. */
export function editable({ id, labels, cogency }: RuleSetDocument): RuleSetDraft {
  return { id, labels, cogency: cogency ?? [] };
}
