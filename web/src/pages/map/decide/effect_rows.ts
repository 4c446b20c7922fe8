/** Which counts a change of labels would change. */

import type { LabelPreview } from "../../../service/types";

export interface EffectRow {
  readonly what: "effectFaces" | "effectLocations" | "effectCogent" | "effectAccess" | "effectInvalid" | "effectLinks";
  /** Id of the label that is counted. */
  readonly label?: string;
  readonly before: number;
  readonly after: number;
}

export function effectRows({ labels, edges, links }: LabelPreview["counts"]): EffectRow[] {
  const rows: EffectRow[] = labels.flatMap(({ label, faces, locations }) => [
    { what: "effectFaces", label, ...faces },
    { what: "effectLocations", label, ...locations },
  ]);
  const ofMap = [
    ["effectCogent", edges["cogent"]],
    ["effectAccess", edges["storage-access"]],
    ["effectInvalid", edges["invalid"]],
    ["effectLinks", links["connected"]],
  ] as const;
  for (const [what, count] of ofMap) if (count) rows.push({ what, ...count });
  return rows.filter(({ before, after }) => before !== after);
}
