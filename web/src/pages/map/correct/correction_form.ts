/** The chosen correction: its label, its places, its points; all by keys, too. */

import { button, choice, field, h } from "../../../dom";
import { pointsOf, shapeOf, withPoints, type Correction } from "../../../corrections/correction";
import { aligned, crossesItself, placeCount, turned } from "../../../corrections/geometry";
import { number, t } from "../../../language";
import type { Point } from "../../../map/frame";
import type { Label } from "../../../service/types";

export interface FormEvents {
  readonly labels: readonly Label[];
  /** Directions that points are aligned with, radians. */
  readonly directions: readonly number[];
  change(correction: Correction): void;
  remove(): void;
}

/** Finest step of a length in a field, metres. */
const STEP = 0.01;

export function correctionForm(correction: Correction, events: FormEvents): HTMLElement {
  const { change, directions } = events;
  const points = pointsOf(correction);
  const shape = shapeOf(correction.kind);
  const canAlign = shape !== "points" && correction.kind !== "row";
  const isTwisted = shape === "ring" && correction.kind !== "row" && crossesItself(points);
  return h(
    "section",
    { class: "correction-form", "aria-label": t("chosenCorrection") },
    ...fields(correction, events),
    isTwisted && h("p", { class: "warning", role: "alert" }, t("crossesItself")),
    h(
      "div",
      { class: "line" },
      canAlign &&
        button(t("align"), () => change(withPoints(correction, aligned(points, shape === "ring", directions))), {
          id: "correction-align",
        }),
      correction.kind === "row" &&
        button(t("turnRow"), () => change({ ...correction, rectangle: turned(correction.rectangle) }), {
          id: "correction-turn",
        }),
      button(t("remove", { name: t("correction") }), events.remove, { id: "correction-remove" }),
    ),
    pointTable(correction, points, change),
  );
}

function fields(correction: Correction, { labels, change }: FormEvents): HTMLElement[] {
  switch (correction.kind) {
    case "draw":
      return [
        labelField(correction.label, labels, (label) => change({ ...correction, label })),
        nameField(correction.name ?? "", (name) => {
          const { name: _, ...unnamed } = correction;
          change(name === "" ? unnamed : { ...unnamed, name });
        }),
      ];
    case "label":
      return [labelField(correction.label, labels, (label) => change({ ...correction, label }))];
    case "name":
      return [nameField(correction.name, (name) => change({ ...correction, name }))];
    case "row":
      return rowFields(correction, labels, change);
    case "door":
      return [
        choiceField(
          t("kindDoor"),
          [
            ["open", t("doorOpen")],
            ["shut", t("doorShut")],
          ],
          correction.isOpen ? "open" : "shut",
          (value) => change({ ...correction, isOpen: value === "open" }),
        ),
      ];
    default:
      return [];
  }
}

function rowFields(
  row: Correction & { kind: "row" },
  labels: readonly Label[],
  change: (correction: Correction) => void,
): HTMLElement[] {
  const { places: _places, pitchM: _pitchM, ...rest } = row;
  const count = placeCount(row);
  const whole = (value: number): number => Math.max(1, Math.round(value) || 1);
  const [first, second] = row.rectangle;
  const length = first && second ? Math.hypot(second[0] - first[0], second[1] - first[1]) : 0;
  return [
    numberField("correction-places", t("places"), count, 1, (value) => change({ ...rest, places: whole(value) })),
    numberField("correction-pitch", t("pitch"), row.pitchM ?? length / count, STEP, (value) => {
      if (value > 0) change({ ...rest, pitchM: value });
    }),
    numberField("correction-layers", t("layersInDepth"), row.layers, 1, (value) =>
      change({ ...row, layers: whole(value) }),
    ),
    labelField(row.label ?? "", labels, (label) => change({ ...row, label })),
  ];
}

function labelField(label: string, labels: readonly Label[], set: (label: string) => void): HTMLElement {
  const options = labels.map(({ id, name }, index) => [id, `${index + 1} ${name}`] as const);
  const all = labels.some(({ id }) => id === label) ? options : [[label, label || "–"] as const, ...options];
  return choiceField(t("correctionLabel"), all, label, set);
}

function choiceField(
  name: string,
  options: readonly (readonly [string, string])[],
  chosen: string,
  set: (value: string) => void,
): HTMLElement {
  return field(name, choice(options, chosen, set, { id: "correction-choice" }));
}

function nameField(name: string, set: (name: string) => void): HTMLElement {
  const input = h("input", {
    type: "text",
    value: name,
    maxlength: 200,
    autocomplete: "off",
    id: "correction-name",
    onchange: () => set(input.value.trim()),
  });
  return field(t("name"), input);
}

function numberField(id: string, name: string, value: number, step: number, set: (value: number) => void): HTMLElement {
  const input = h("input", {
    type: "number",
    id,
    step,
    min: step,
    value: step === 1 ? value : value.toFixed(2),
    onchange: () => {
      if (Number.isFinite(input.valueAsNumber)) set(input.valueAsNumber);
    },
  });
  return field(name, input);
}

/** Every point in figures: exact, and without a pointer. */
function pointTable(
  correction: Correction,
  points: readonly Point[],
  change: (correction: Correction) => void,
): HTMLElement {
  const canMoveAlone = correction.kind !== "row";
  const input = (index: number, axis: 0 | 1): HTMLElement => {
    const name = t("coordinate", { axis: axis === 0 ? "x" : "y", point: index + 1 });
    const value = points[index]?.[axis] ?? 0;
    if (!canMoveAlone) return h("span", {}, number(value, 2));
    const element = h("input", {
      type: "number",
      step: STEP,
      value: value.toFixed(2),
      id: `point-${index}-${axis}`,
      "aria-label": name,
      onchange: () => {
        if (!Number.isFinite(element.valueAsNumber)) return;
        const to = element.valueAsNumber;
        const moved = points.map((point, at): Point =>
          at !== index ? point : axis === 0 ? [to, point[1]] : [point[0], to],
        );
        change(withPoints(correction, moved));
      },
    });
    return element;
  };
  return h(
    "details",
    { class: "points" },
    h("summary", {}, t("pointsInMetres", { count: points.length })),
    h(
      "table",
      {},
      h(
        "thead",
        {},
        h("tr", {}, ...["", "x", "y"].map((head) => (head ? h("th", { scope: "col" }, head) : h("td", {})))),
      ),
      h(
        "tbody",
        {},
        ...points.map((_, index) =>
          h("tr", {}, h("th", { scope: "row" }, index + 1), h("td", {}, input(index, 0)), h("td", {}, input(index, 1))),
        ),
      ),
    ),
  );
}
