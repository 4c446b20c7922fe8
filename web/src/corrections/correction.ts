/** What a person says about a map that no automatic reading got right. Points are metres of the map frame. */

import type { Point } from "../map/frame";
import type { components } from "../service/openapi";
import type { ListedCorrection } from "../service/types";

/** The members of a document with its points and lists of points as this page has them: the document tells no length. */
type WithPoints<T> = {
  readonly [Name in keyof T]: T[Name] extends number[][]
    ? readonly Point[]
    : T[Name] extends number[]
      ? Point
      : T[Name];
};

/** One correction, as the service reads it. */
export type Correction = WithPoints<components["schemas"]["Correction"]>;

export type Kind = Correction["kind"];

/** A correction as the service lists it, with what became of it. One that is only previewed has no id. */
export type Listed = Correction & Readonly<Pick<ListedCorrection, "id" | "isApplied" | "faces" | "reason">>;

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
  const { id: _id, isApplied: _isApplied, faces: _faces, reason: _reason, ...correction } = listed;
  return correction as Correction;
}
