/** How features look. Colours are those of Okabe and Ito, which people with any colour vision tell apart. */

import { Circle, Fill, Stroke, Style, Text } from "ol/style";

export const COLORS = {
  cogent: "#1a1a1a",
  "storage-access": "#d55e00",
  invalid: "#9a9a9a",
  connected: "#0072b2",
  disconnected: "#9a9a9a",
  occupied: "#d55e00",
  empty: "#56b4e9",
  unknown: "#9a9a9a",
  line: "#cc79a7",
  region: "#cc79a7",
  door: "#cc79a7",
  location: "#00614a",
  chosen: "#c2185b",
  route: "#0047ab",
  added: "#0072b2",
  removed: "#d55e00",
  changed: "#cc79a7",
  stale: "#e69f00",
} as const;

const made = new Map<string, Style>();

function once(key: string, make: () => Style): Style {
  const known = made.get(key) ?? make();
  made.set(key, known);
  return known;
}

/** A translucent area with a thin border. */
export function area(color: string, opacity = 0.5): Style {
  return once(`area ${color} ${opacity}`, () => {
    const alpha = Math.round(opacity * 255)
      .toString(16)
      .padStart(2, "0");
    return new Style({
      fill: new Fill({ color: `${color}${alpha}` }),
      stroke: new Stroke({ color: `${color}cc`, width: 0.5 }),
    });
  });
}

export function line(color: string, width: number, dash: number[] = []): Style {
  return once(
    `line ${color} ${width} ${dash.join()}`,
    () => new Style({ stroke: new Stroke({ color, width, lineDash: dash }) }),
  );
}

export function dot(color: string, radius: number): Style {
  return once(
    `dot ${color} ${radius}`,
    () =>
      new Style({
        image: new Circle({ radius, fill: new Fill({ color }), stroke: new Stroke({ color: "#fff", width: 1 }) }),
      }),
  );
}

export function label(text: string): Style {
  return new Style({
    text: new Text({
      text,
      font: "11px sans-serif",
      fill: new Fill({ color: "#111" }),
      stroke: new Stroke({ color: "#fff", width: 3 }),
    }),
  });
}

/** What is under the pointer, and what was chosen. */
export const CHOSEN = [
  new Style({ stroke: new Stroke({ color: "#fff", width: 5 }), fill: new Fill({ color: `${COLORS.chosen}33` }) }),
  new Style({
    stroke: new Stroke({ color: COLORS.chosen, width: 2.5 }),
    image: new Circle({ radius: 7, stroke: new Stroke({ color: COLORS.chosen, width: 3 }) }),
  }),
];
