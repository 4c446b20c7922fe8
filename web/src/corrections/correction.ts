/** What a person says about a map that no automatic reading got right. Points are metres of the map frame. */

import type { Point } from "../map/frame";

export type Correction =
  /** What lies inside a ring is one face. */
  | { readonly kind: "draw"; readonly ring: readonly Point[]; readonly label: string; readonly name?: string }
  /** The faces that a line crosses are cut along it. */
  | { readonly kind: "split"; readonly line: readonly Point[] }
  /** The faces at these points become one. */
  | { readonly kind: "merge"; readonly at: readonly Point[] }
  /** A rectangle, its first side along the row, is cut into places: so many, or one for each pitch. */
  | {
      readonly kind: "row";
      readonly rectangle: readonly Point[];
      readonly places?: number;
      /** Metres. */
      readonly pitchM?: number;
      /** Places one behind the other. */
      readonly layers: number;
      readonly label?: string;
    }
  /** What was found inside a ring joins the ground around it. */
  | { readonly kind: "erase"; readonly ring: readonly Point[] }
  /** The face at a point has a label. */
  | { readonly kind: "label"; readonly at: Point; readonly label: string }
  /** The border along a line is a door, or is shut. */
  | { readonly kind: "door"; readonly line: readonly Point[]; readonly isOpen: boolean }
  /** The face at a point has a name. */
  | { readonly kind: "name"; readonly at: Point; readonly name: string };

export type Kind = Correction["kind"];

/** A correction as the service lists it, with what became of it. */
export type Listed = Correction & {
  /** A correction that is only previewed has none. */
  readonly id?: string;
  readonly isApplied: boolean;
  /** Why it does not fit. */
  readonly reason?: string;
};

/** The shape of a kind: a closed ring, a line, single points. */
export function shapeOf(kind: Kind): "ring" | "line" | "points" {
  if (kind === "draw" || kind === "erase" || kind === "row") return "ring";
  return kind === "split" || kind === "door" ? "line" : "points";
}

/** All its points; the first one of a ring is not repeated at its end. */
export function pointsOf(correction: Correction): readonly Point[] {
  switch (correction.kind) {
    case "draw":
    case "erase":
      return open(correction.ring);
    case "row":
      return correction.rectangle;
    case "split":
    case "door":
      return correction.line;
    case "merge":
      return correction.at;
    case "label":
    case "name":
      return [correction.at];
  }
}

/** The correction with other points, as many as `pointsOf` tells. */
export function withPoints(correction: Correction, points: readonly Point[]): Correction {
  switch (correction.kind) {
    case "draw":
    case "erase":
      return { ...correction, ring: points };
    case "row":
      return { ...correction, rectangle: points };
    case "split":
    case "door":
      return { ...correction, line: points };
    case "merge":
      return { ...correction, at: points };
    case "label":
    case "name":
      return { ...correction, at: points[0] ?? correction.at };
  }
}

function open(ring: readonly Point[]): readonly Point[] {
  const [first, last] = [ring[0], ring.at(-1)];
  return ring.length > 1 && first?.[0] === last?.[0] && first?.[1] === last?.[1] ? ring.slice(0, -1) : ring;
}

/** What is sent of a listed correction: without what the service adds. */
export function plain(listed: Listed): Correction {
  const { id: _id, isApplied: _isApplied, reason: _reason, ...correction } = listed as Listed & { faces?: unknown };
  const { faces: _faces, ...rest } = correction as { faces?: unknown };
  return rest as Correction;
}
