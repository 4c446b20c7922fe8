/** The labels of a version as they are saved: names, colours, and the colour of a face. */

import type { FeatureLike } from "ol/Feature";

import { labelIn } from "../../../labels/draft";
import { rowOf } from "../../../map/geojson";
import { COLORS } from "../../../map/look";
import { get } from "../../../service/request";
import type { Label, RuleSet, Semantics } from "../../../service/types";

export interface SavedLabels {
  readonly semantics: Semantics;
  readonly labels: readonly Label[];
  colorOf(face: FeatureLike): string;
}

/** Reads the labels that a path answers. */
export async function readLabels(path: string): Promise<SavedLabels> {
  const semantics = await get<Semantics>(path);
  const { labels } = await get<RuleSet>(`v1/rule-sets/${encodeURIComponent(semantics.ruleSet)}`);
  const colors = new Map(labels.map(({ id, color }) => [id, color]));
  const label = labelIn(semantics);
  return { semantics, labels, colorOf: (face) => colors.get(label(rowOf(face)) ?? "") ?? COLORS.unknown };
}
