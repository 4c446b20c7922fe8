/** What the tools of a map share. */

import type Feature from "ol/Feature";

import type { Labels } from "../../labels/labels";
import type { Collections } from "../../map/collections";
import type { Coordinates } from "../../map/coordinates";
import type { Point } from "../../map/frame";
import type { MapCanvas } from "../../map/map_canvas";
import type { MapView } from "../../service/types";
import type { TextName } from "../../texts/texts";

export interface Workspace {
  readonly map: MapView;
  readonly collections: Collections;
  readonly coordinates: Coordinates;
  readonly canvas: MapCanvas;
  readonly labels: Labels;
  /** Shows what went wrong. */
  failed(error: unknown): void;
  /** Takes away what was shown of it: something is tried anew. */
  clearProblems(): void;
  /** Chooses a feature: marks it and shows what is known of it. */
  choose(features: readonly Feature[]): void;
}

/** A tool while it is open. */
export interface OpenTool {
  readonly element: HTMLElement;
  /** Answers a click on the map; where it is absent, a click shows what is there. */
  click?(point: Point, features: readonly Feature[]): void;
  /** Answers a key that no field takes. */
  key?(event: KeyboardEvent): void;
  /** Takes away what it drew. */
  close(): void;
}

/** A tool for a map: a name in the row of tabs and what opens under it. */
export interface Tool {
  readonly id: string;
  readonly name: TextName;
  open(workspace: Workspace): OpenTool;
}
