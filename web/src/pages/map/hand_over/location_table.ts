/** The storage locations as a table that is sorted and filtered; a line leads to its place on the map. */

import type Feature from "ol/Feature";

import { button, field, h, replace } from "../../../dom";
import { number, t } from "../../../language";
import { rowOf, type Properties } from "../../../map/geojson";
import type { TextName } from "../../../texts/texts";
import type { Workspace } from "../workspace";
import { COLUMNS, shownRows, type Column, type Order } from "./table_rows";

/** Lines that are drawn at once; the filter leads to the others. */
const MOST = 200;
/** Metres around a location that is flown to. */
const MARGIN = 6;

/** The heads of the columns, by the names of their texts. */
const TITLES = {
  code: "columnCode",
  name: "columnName",
  aisle: "columnAisle",
  bay: "columnBay",
  side: "columnSide",
  label: "columnLabel",
  widthM: "columnWidthM",
  depthM: "columnDepthM",
  occupancy: "columnOccupancy",
} as const satisfies Record<Column, TextName>;

/** Words of the service that the page has in both languages. */
const WORDS = {
  left: "sideLeft",
  right: "sideRight",
  occupied: "occupied",
  empty: "empty",
  unknown: "unknown",
} as const satisfies Record<string, TextName>;

function isWord(value: unknown): value is keyof typeof WORDS {
  return typeof value === "string" && value in WORDS;
}

export function locationTable(workspace: Workspace): HTMLElement {
  const { map, collections, labels, failed } = workspace;
  let rows: Properties[] = [];
  let order: Order = { column: "code", isDescending: false };
  const filter = h("input", { type: "search", autocomplete: "off", oninput: () => show() });
  const count = h("p", { role: "status" });
  const table = h("table", {});

  function show(): void {
    const shown = shownRows(rows, filter.value, order);
    replace(count, counted(shown.length));
    replace(
      table,
      h("thead", {}, h("tr", {}, ...COLUMNS.map(head))),
      h(
        "tbody",
        {},
        ...shown.slice(0, MOST).map((row) => h("tr", {}, ...COLUMNS.map((column) => h("td", {}, cell(row, column))))),
      ),
    );
  }

  function counted(found: number): string {
    const all = rows.length;
    if (all === 0) return t("noLocations");
    if (found > MOST) return t("rowsShown", { shown: MOST, found, all });
    return found === all ? t("allShown", { all }) : t("rowsFound", { found, all });
  }

  function head(column: Column): HTMLElement {
    const isSorted = order.column === column;
    const sort = (): void => {
      order = { column, isDescending: isSorted && !order.isDescending };
      show();
      document.getElementById(`sort-${column}`)?.focus();
    };
    const direction = !isSorted ? "none" : order.isDescending ? "descending" : "ascending";
    const arrow = !isSorted ? "" : order.isDescending ? " ▼" : " ▲";
    return h(
      "th",
      { scope: "col", "aria-sort": direction },
      button(`${t(TITLES[column])}${arrow}`, sort, { id: `sort-${column}` }),
    );
  }

  function cell(row: Properties, column: Column): HTMLElement | string {
    const value = row[column];
    if (column === "code") return button(String(value), () => fly(String(value)));
    return typeof value === "number" ? number(value, column.endsWith("M") ? 2 : 0) : String(value ?? "");
  }

  /** The row of a location in the words of the page. */
  function inWords(location: Feature): Properties {
    const row = rowOf(location);
    const word = (value: unknown): string => (isWord(value) ? t(WORDS[value]) : String(value ?? ""));
    const label = labels.label(String(row["label"]))?.name ?? row["label"];
    return { ...row, label, side: word(row["side"]), occupancy: word(row["occupancy"]) };
  }

  function fly(code: string): void {
    const feature = collections.source("locations").getFeatureById(`locations/${code}`);
    if (!feature || Array.isArray(feature)) return;
    const [left = 0, low = 0, right = 0, high = 0] = feature.getGeometry()?.getExtent() ?? [];
    workspace.canvas.fit([left - MARGIN, low - MARGIN, right + MARGIN, high + MARGIN], 300);
    workspace.choose([feature]);
  }

  collections.read("locations").then((source) => {
    rows = source.getFeatures().map(inWords);
    show();
  }, failed);
  return h(
    "section",
    { "aria-labelledby": "table-title" },
    h("h2", { id: "table-title" }, t("locationTable")),
    field(t("filter"), filter),
    count,
    h("div", { class: "scroll big", tabindex: 0, role: "group", "aria-label": t("locationTable") }, table),
    h(
      "p",
      {},
      h("a", { href: `v1/maps/${map.id}/exports/locations.csv`, download: "locations.csv" }, t("downloadCsv")),
      " · ",
      h("a", { href: `v1/maps/${map.id}/exports/locations.xlsx`, download: "locations.xlsx" }, t("downloadSheet")),
    ),
  );
}
