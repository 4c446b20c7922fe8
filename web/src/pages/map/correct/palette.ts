/** What can be drawn, and how it is done. */

import { button, choice, field, h } from "../../../dom";
import { number, t } from "../../../language";
import { MODES, type Mode } from "./modes";
import type { Snapping } from "./snapping";

export interface PaletteState {
  /** What is being drawn. */
  readonly mode: Mode | undefined;
  readonly snap: Snapping;
  /** Direction of rectangles, radians. */
  readonly direction: number;
  begin(mode: Mode | undefined): void;
  turn(direction: number): void;
}

export function palette({ mode, snap, direction, begin, turn }: PaletteState): HTMLElement {
  const snapBox = h("input", {
    type: "checkbox",
    id: "snap",
    checked: snap.isOn,
    onchange: () => void (snap.isOn = snapBox.checked),
  });
  // A rectangle that lies along a direction lies along the one across it, too.
  const directions = snap.directions
    .filter((angle) => angle < Math.PI / 2)
    .map((angle) => [String(angle), t("degrees", { angle: number((angle * 180) / Math.PI, 1) })] as const);
  return h(
    "div",
    {},
    h(
      "div",
      { class: "line", role: "toolbar", "aria-label": t("corrections") },
      ...MODES.map((one) =>
        button(t(`mode-${one.id}`), () => begin(one === mode ? undefined : one), {
          "aria-pressed": String(one === mode),
          "aria-keyshortcuts": one.key.toUpperCase(),
          title: one.key.toUpperCase(),
          id: `mode-${one.id}`,
        }),
      ),
    ),
    mode && h("p", { role: "status" }, t(`how-${mode.id}`), " ", h("small", {}, t("penKeys"))),
    mode?.shape === "rectangle" &&
      directions.length > 1 &&
      field(
        t("rectangleDirection"),
        choice(directions, String(direction), (value) => turn(Number(value)), { id: "direction" }),
      ),
    h("label", { class: "line" }, snapBox, t("snap")),
  );
}
