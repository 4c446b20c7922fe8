/** What the draft would do, as the service tells it: counted here, and the faces that it changes marked on the map. */

import Feature from "ol/Feature";
import VectorSource from "ol/source/Vector";

import { h, replace } from "../../../dom";
import { t } from "../../../language";
import { isEmpty, previewOf } from "../../../labels/draft";
import { geometryOf, type GeoJsonFeature } from "../../../map/geojson";
import { COLORS, line } from "../../../map/look";
import { clear, problemBox, show } from "../../../parts/problem";
import { onConnection } from "../../../service/connection";
import { ask } from "../../../service/request";
import type { LabelPreview } from "../../../service/types";
import type { Workspace } from "../workspace";
import { effectRows, type EffectRow } from "./effect_rows";

/** Milliseconds after the last change of the draft until its effect is asked for. */
const PATIENCE_MS = 250;

export function effect({ map, canvas, coordinates, labels }: Workspace): {
  readonly element: HTMLElement;
  close(): void;
} {
  const source = new VectorSource();
  const layer = canvas.overlay(source, 80, { style: line(COLORS.chosen, 2) });
  const problems = problemBox();
  const content = h("div", { role: "status" });
  const element = h("section", { "aria-label": t("effect"), hidden: true }, problems, content);
  let asked: unknown;
  let isOpen = true;
  let timer = 0;
  let latest: AbortController | undefined;

  async function read(): Promise<void> {
    latest?.abort();
    latest = new AbortController();
    const { draft } = labels;
    const path = `v1/maps/${map.id}/semantics/preview?${new URLSearchParams({ crs: coordinates.crs, limit: "10000" })}`;
    try {
      const response = await ask(path, { method: "POST", json: previewOf(draft), signal: latest.signal });
      const preview = (await response.json()) as LabelPreview;
      if (labels.draft !== draft) return;
      draw(preview);
    } catch (error) {
      if (error instanceof DOMException) return;
      replace(content);
      show(problems, error);
    }
  }

  function draw({ features, numberMatched, counts }: LabelPreview): void {
    clear(problems);
    source.clear();
    const changed = features as unknown as readonly GeoJsonFeature[];
    for (const { geometry } of changed) {
      source.addFeature(new Feature(geometryOf(geometry, coordinates.toMap) ?? undefined));
    }
    labels.showPreview(new Map(changed.map(({ id, properties }) => [Number(id), String(properties?.["label"])])));
    const rows = effectRows(counts);
    const title = h("strong", {}, t("facesWouldChange", { count: numberMatched }));
    replace(content, rows.length > 0 ? h("details", { open: isOpen }, h("summary", {}, title), table(rows)) : title);
    content.querySelector("details")?.addEventListener("toggle", (event) => {
      isOpen = (event.target as HTMLDetailsElement).open;
    });
  }

  function table(rows: readonly EffectRow[]): HTMLElement {
    const name = (id: string | undefined): string => (id === undefined ? "" : (labels.label(id)?.name ?? id));
    return h(
      "table",
      {},
      h("thead", {}, h("tr", {}, h("td", {}), head(t("now")), head(t("then")))),
      h(
        "tbody",
        {},
        ...rows.map(({ what, label, before, after }) =>
          h(
            "tr",
            {},
            h("th", { scope: "row" }, t(what, { label: name(label) })),
            h("td", {}, before),
            h("td", {}, after),
          ),
        ),
      ),
    );
  }

  function update(): void {
    const { draft } = labels;
    element.hidden = isEmpty(draft);
    if (asked === draft) return;
    asked = draft;
    source.clear();
    clearTimeout(timer);
    latest?.abort();
    if (!isEmpty(draft)) timer = setTimeout(() => void read(), PATIENCE_MS);
  }

  const stop = labels.onChange(update);
  const stopConnection = onConnection((isGone) => {
    if (!isGone && !isEmpty(labels.draft)) void read();
  });
  update();
  return {
    element,
    close: () => {
      stop();
      stopConnection();
      clearTimeout(timer);
      latest?.abort();
      canvas.remove(layer);
    },
  };
}

function head(text: string): HTMLElement {
  return h("th", { scope: "col" }, text);
}
