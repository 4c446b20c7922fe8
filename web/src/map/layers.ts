/** The layers of a map, from below to above. */

import type { FeatureLike } from "ol/Feature";
import type { Style } from "ol/style";

import type { TextName } from "../texts/texts";
import { rowOf } from "./geojson";
import { area, COLORS, dot, label, line } from "./look";

/** What the colours of labels and borders follow from: labels in force with the changes that are not saved yet. */
export interface Reading {
  /** The colour of a face's or place's label. */
  colorOf(feature: FeatureLike): string;
  /** The cogency of an edge. */
  cogencyOf(feature: FeatureLike): keyof typeof COLORS;
}

export interface LayerKind {
  readonly id: string;
  readonly name: TextName;
  readonly collections: readonly string[];
  readonly isShown: boolean;
  /** Metres a pixel up to which it is drawn. */
  readonly maxResolution?: number;
  readonly style: (feature: FeatureLike, reading: Reading) => Style | Style[] | undefined;
  /** What its colours mean; that of labels follows from the rule set. */
  readonly legend: readonly (readonly [color: string, name: TextName])[];
}

const word = (feature: FeatureLike, name: string): keyof typeof COLORS =>
  String(rowOf(feature)[name]) as keyof typeof COLORS;

export const LAYERS: readonly LayerKind[] = [
  {
    id: "regions",
    name: "regions",
    collections: ["regions"],
    isShown: false,
    style: () => [area(COLORS.region, 0.12), line(COLORS.region, 3, [8, 6])],
    legend: [[COLORS.region, "regions"]],
  },
  {
    id: "faces",
    name: "faces",
    collections: ["faces"],
    isShown: true,
    style: (feature, reading) => area(reading.colorOf(feature)),
    legend: [],
  },
  {
    id: "occupancy",
    name: "occupancy",
    collections: ["locations"],
    isShown: false,
    style: (feature) => area(COLORS[word(feature, "occupancy")] ?? COLORS.unknown, 0.75),
    legend: [
      [COLORS.occupied, "occupied"],
      [COLORS.empty, "empty"],
      [COLORS.unknown, "unknown"],
    ],
  },
  {
    id: "places",
    name: "places",
    collections: ["places"],
    isShown: false,
    style: (feature, reading) => [area(reading.colorOf(feature), 0.25), line(reading.colorOf(feature), 3)],
    legend: [],
  },
  {
    id: "lines",
    name: "lines",
    collections: ["lines"],
    isShown: false,
    style: () => line(COLORS.line, 1.2, [4, 4]),
    legend: [[COLORS.line, "lines"]],
  },
  {
    id: "edges",
    name: "edges",
    collections: ["edges"],
    isShown: true,
    style: (feature, reading) => {
      const cogency = reading.cogencyOf(feature);
      return line(COLORS[cogency], cogency === "invalid" ? 0.7 : 1.8, cogency === "storage-access" ? [5, 3] : []);
    },
    legend: [
      [COLORS.cogent, "cogent"],
      [COLORS["storage-access"], "storageAccess"],
      [COLORS.invalid, "invalid"],
    ],
  },
  {
    id: "graph",
    name: "graph",
    collections: ["links", "nodes"],
    isShown: false,
    style: (feature) =>
      feature.getGeometry()?.getType() === "Point"
        ? dot(COLORS.connected, 3)
        : line(
            COLORS[word(feature, "connectivity")] ?? COLORS.unknown,
            word(feature, "connectivity") === "disconnected" ? 0.5 : 1.5,
          ),
    legend: [
      [COLORS.connected, "connected"],
      [COLORS["storage-access"], "storageAccess"],
      [COLORS.disconnected, "disconnected"],
    ],
  },
  {
    id: "doors",
    name: "doors",
    collections: ["doors"],
    isShown: true,
    style: () => line(COLORS.door, 5),
    legend: [[COLORS.door, "doors"]],
  },
  {
    id: "locations",
    name: "locations",
    collections: ["locations"],
    isShown: true,
    maxResolution: 0.06,
    style: (feature) => {
      const row = rowOf(feature);
      const name = String(row["name"] ?? row["code"]);
      return row["stale"] === true
        ? [line(COLORS.stale, 3, [6, 4]), label(`${name} ?`)]
        : [line(COLORS.location, 1), label(name)];
    },
    legend: [
      [COLORS.location, "codeCurrent"],
      [COLORS.stale, "codeStale"],
    ],
  },
];
