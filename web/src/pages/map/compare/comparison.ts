/** What a map is compared with: what is drawn at the left, what is drawn at both sides, and what changed. */

import type Layer from "ol/layer/Layer";

import type { ChangeGroup } from "../change_list";

export interface Comparison {
  /** What is compared with, drawn at the left of the divider. */
  readonly layers: readonly Layer[];
  readonly name: string;
  /** What the map is called at the right; the version in force where it is absent. */
  readonly nameInForce?: string;
  /** Whether the picture of the map lies at the right only. */
  readonly hasPicture: boolean;
  /** What is to be said of it before the changes. */
  readonly remarks: readonly (string | HTMLElement)[];
  readonly groups: readonly ChangeGroup[];
  /** What can be done with it, before the changes. */
  readonly actions?: HTMLElement;
}
