/** The labels of a rule set: their names and colours. */

import { COLORS } from "../../../map/look";
import { get } from "../../../service/request";
import type { Label, RuleSet } from "../../../service/types";

export interface LabelColors {
  readonly labels: readonly Label[];
  /** The colour of a label. */
  of(id: unknown): string;
}

export async function readColors(ruleSet: string): Promise<LabelColors> {
  const { labels } = await get<RuleSet>(`v1/rule-sets/${encodeURIComponent(ruleSet)}`);
  const colors = new Map<unknown, string>(labels.map(({ id, color }) => [id, color]));
  return { labels, of: (id) => colors.get(id) ?? COLORS.unknown };
}
