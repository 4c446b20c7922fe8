/** The rows of the table of locations: which are shown, in which order. */

import type { Properties } from "../../../map/geojson";

/** The columns of the table, by the names of the properties. */
export const COLUMNS = ["code", "name", "aisle", "bay", "side", "label", "widthM", "depthM", "occupancy"] as const;
export type Column = (typeof COLUMNS)[number];

export interface Order {
  readonly column: Column;
  readonly isDescending: boolean;
}

/** The rows with a text in some column, in an order. */
export function shownRows(rows: readonly Properties[], text: string, { column, isDescending }: Order): Properties[] {
  const wanted = text.trim().toLowerCase();
  const has = (row: Properties): boolean =>
    COLUMNS.some((name) =>
      String(row[name] ?? "")
        .toLowerCase()
        .includes(wanted),
    );
  const sorted = rows.filter(has).sort((left, right) => compare(left[column], right[column]));
  return isDescending ? sorted.reverse() : sorted;
}

function compare(left: unknown, right: unknown): number {
  if (typeof left === "number" && typeof right === "number") return left - right;
  return String(left ?? "").localeCompare(String(right ?? ""), undefined, { numeric: true });
}
