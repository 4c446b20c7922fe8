/** How well the map fits a truth file, in figures; the truth is drawn over the map. */

import Feature from "ol/Feature";
import VectorSource from "ol/source/Vector";

import { field, h, replace } from "../../../dom";
import { number, t } from "../../../language";
import { geometryOf, type GeoJsonFeature } from "../../../map/geojson";
import { COLORS, line } from "../../../map/look";
import { clear, problemBox, show } from "../../../parts/problem";
import { ask } from "../../../service/request";
import type { Evaluation, LabelScores } from "../../../service/types";
import type { Workspace } from "../workspace";

export function evaluation({ map, canvas }: Workspace): { readonly element: HTMLElement; close(): void } {
  const source = new VectorSource();
  const layer = canvas.overlay(source, 55, { style: line(COLORS.chosen, 1.8) });
  const problems = problemBox();
  const answer = h("div", { "aria-live": "polite" });
  const input = h("input", { type: "file", accept: ".geojson,.json", onchange: () => void evaluate(input.files?.[0]) });

  async function evaluate(file: File | undefined): Promise<void> {
    if (!file) return;
    clear(problems);
    replace(answer);
    source.clear();
    try {
      const headers = { "Content-Type": "application/geo+json" };
      const response = await ask(`v1/maps/${map.id}/evaluations`, { method: "POST", body: file, headers });
      replace(answer, scores((await response.json()) as Evaluation));
      // The service has read it: it is a collection in metres of the map frame.
      const truth = JSON.parse(await file.text()) as { features: GeoJsonFeature[] };
      source.addFeatures(truth.features.map((feature) => drawn(feature)));
    } catch (error) {
      show(problems, error);
    } finally {
      input.value = "";
    }
  }

  const element = h(
    "section",
    { "aria-labelledby": "evaluation-title" },
    h("h2", { id: "evaluation-title" }, t("evaluation")),
    field(t("truthFile"), input, t("truthMeaning")),
    problems,
    answer,
  );
  return { element, close: () => canvas.remove(layer) };
}

function drawn({ geometry }: GeoJsonFeature): Feature {
  return new Feature(geometryOf(geometry, (point) => point) ?? undefined);
}

function scores({ geometry, automatic, assigned }: Evaluation): HTMLElement {
  const columns = [
    ["suggestedLabels", automatic] as const,
    ...(assigned ? [["decidedLabels", assigned] as const] : []),
  ];
  const share = (value: number | null | undefined): string =>
    value === null || value === undefined ? "–" : `${number(value * 100, 1)} %`;
  const rows: [string, (scores: LabelScores) => string][] = [
    [t("placesFound"), ({ places }) => share(places?.strict)],
    [t("placesSystematic"), ({ places }) => share(places?.systematic)],
    [t("precision"), ({ precision }) => share(precision)],
    ["F1", ({ f1 }) => share(f1)],
    [t("overlap", { label: "co" }), ({ iou }) => share(iou.co)],
    [t("overlap", { label: "ju" }), ({ iou }) => share(iou.ju)],
    [t("overlap", { label: "pc" }), ({ iou }) => share(iou.pc)],
  ];
  return h(
    "div",
    {},
    h(
      "table",
      {},
      h("thead", {}, h("tr", {}, h("td", {}), ...columns.map(([name]) => h("th", { scope: "col" }, t(name))))),
      h(
        "tbody",
        {},
        ...rows.map(([name, value]) =>
          h("tr", {}, h("th", { scope: "row" }, name), ...columns.map(([, one]) => h("td", {}, value(one)))),
        ),
      ),
    ),
    h("p", {}, t("borders", { found: share(geometry.boundaryRecall), right: share(geometry.boundaryPrecision) })),
  );
}
