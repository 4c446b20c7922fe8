/** What the corrections would do, as the service tells it: which fit, which faces they make, change and take away. */

import Feature from "ol/Feature";
import VectorSource from "ol/source/Vector";
import type Style from "ol/style/Style";

import { h, replace } from "../../../dom";
import type { Corrections } from "../../../corrections/corrections";
import type { Listed } from "../../../corrections/correction";
import { t } from "../../../language";
import { geometryOf, type GeoJsonFeature } from "../../../map/geojson";
import { area, COLORS, line } from "../../../map/look";
import { clear, problemBox, show } from "../../../parts/problem";
import { onConnection } from "../../../service/connection";
import { ask } from "../../../service/request";
import type { Workspace } from "../workspace";

/** Milliseconds after the last change until its outcome is asked for. */
const PATIENCE_MS = 250;

/** What is read of the preview of corrections. */
interface Preview {
  readonly corrections: readonly Listed[];
  readonly faces: Readonly<Record<"added" | "removed" | "reshaped" | "relabelled", number>>;
  readonly features: readonly GeoJsonFeature[];
}

export interface OutcomeView {
  readonly element: HTMLElement;
  /** Why the correction at a place of the wanted list does not fit; nothing where it does, or is not known yet. */
  misfit(index: number): string | undefined;
  close(): void;
}

export function outcome(workspace: Workspace, corrections: Corrections, told: () => void): OutcomeView {
  const { map, canvas, coordinates, labels } = workspace;
  const source = new VectorSource();
  const layer = canvas.overlay(source, 84, { style: (feature) => feature.get("look") as Style[] });
  const problems = problemBox();
  const content = h("div", { role: "status" });
  let previewed: readonly Listed[] | undefined;
  let asked: unknown;
  let timer = 0;
  let latest: AbortController | undefined;

  async function read(): Promise<void> {
    latest?.abort();
    latest = new AbortController();
    const { draft } = corrections;
    const query = new URLSearchParams({ crs: coordinates.crs, limit: "10000" });
    const path = `v1/maps/${map.id}/semantics/preview?${query}`;
    try {
      const response = await ask(path, { method: "POST", json: corrections.body, signal: latest.signal });
      const preview = (await response.json()) as Preview;
      if (corrections.draft === draft) draw(preview);
    } catch (error) {
      if (error instanceof DOMException) return;
      replace(content);
      show(problems, error);
    }
  }

  function draw({ corrections: listed, faces, features }: Preview): void {
    clear(problems);
    previewed = listed;
    source.clear();
    for (const { geometry, properties } of features) {
      const feature = new Feature(geometryOf(geometry, coordinates.toMap) ?? undefined);
      const isBefore = properties?.["isBefore"] === true;
      const color = labels.color(String(properties?.["label"]));
      feature.set(
        "look",
        isBefore ? [line(COLORS.removed, 1.5, [4, 4])] : [area(color, 0.6), line(COLORS.chosen, 1.5)],
      );
      source.addFeature(feature);
    }
    replace(content, h("p", {}, t("facesWouldBe", faces)));
    told();
  }

  function update(): void {
    if (asked === corrections.draft) return;
    asked = corrections.draft;
    previewed = undefined;
    source.clear();
    replace(content);
    clear(problems);
    clearTimeout(timer);
    latest?.abort();
    if (corrections.count > 0) timer = setTimeout(() => void read(), PATIENCE_MS);
  }

  const stop = corrections.onChange(update);
  const stopConnection = onConnection((isGone) => {
    if (!isGone && corrections.count > 0) void read();
  });
  update();
  return {
    element: h("section", { "aria-label": t("effect") }, problems, content),
    misfit: (index) => {
      const listed = (previewed ?? (corrections.count === 0 ? corrections.listed : []))[index];
      return listed && !listed.isApplied ? (listed.reason ?? t("doesNotFit")) : undefined;
    },
    close: () => {
      stop();
      stopConnection();
      clearTimeout(timer);
      latest?.abort();
      canvas.remove(layer);
    },
  };
}
