/** Corrections in words. */

import type { Correction } from "../../../corrections/correction";
import { placeCount } from "../../../corrections/geometry";
import { t } from "../../../language";
import type { TextName } from "../../../texts/texts";

const KINDS: Readonly<Record<Correction["kind"], TextName>> = {
  draw: "kindDraw",
  split: "kindSplit",
  merge: "kindMerge",
  row: "kindRow",
  erase: "kindErase",
  label: "kindLabel",
  door: "kindDoor",
  name: "kindName",
};

/** What a correction does; `labelName` gives the name of a label. */
export function described(correction: Correction, labelName: (id: string) => string): string {
  const kind = t(KINDS[correction.kind]);
  switch (correction.kind) {
    case "draw":
      return [kind, labelName(correction.label), correction.name].filter(Boolean).join(" · ");
    case "row":
      return [
        kind,
        t("rowSize", { places: placeCount(correction), layers: correction.layers }),
        correction.label && labelName(correction.label),
      ]
        .filter(Boolean)
        .join(" · ");
    case "label":
      return `${kind} · ${labelName(correction.label)}`;
    case "door":
      return `${kind} · ${t(correction.isOpen ? "doorOpen" : "doorShut")}`;
    case "name":
      return `${kind} · ${correction.name}`;
    default:
      return kind;
  }
}
