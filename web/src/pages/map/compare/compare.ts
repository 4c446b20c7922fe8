/** Comparing a map with an earlier version of its labels or with another map: side by side under a divider, and as a list. */

import Feature from "ol/Feature";
import { Point as PointGeometry } from "ol/geom";
import VectorSource from "ol/source/Vector";
import type Style from "ol/style/Style";

import { button, field, h, replace } from "../../../dom";
import { moment, t } from "../../../language";
import type { Point } from "../../../map/frame";
import { dot } from "../../../map/look";
import { clear, problemBox, show } from "../../../parts/problem";
import { listMaps } from "../../../service/maps";
import { get } from "../../../service/request";
import type { Analysis, MapView, Semantics } from "../../../service/types";
import type { OpenTool, Tool, Workspace } from "../workspace";
import { compareAnalysis } from "./analysis_comparison";
import { changeList } from "./change_list";
import type { Comparison } from "./comparison";
import { compareMap } from "./map_comparison";
import { differentOptions } from "./different_options";
import { swipe } from "./swipe";
import { compareVersion } from "./version_comparison";

export const compare: Tool = { id: "compare", name: "compare", open };

/** Metres around a change that is flown to. */
const MARGIN = 6;

function open(workspace: Workspace): OpenTool {
  const { map, canvas, labels, failed } = workspace;
  const problems = problemBox();
  const answer = h("div", {});
  const select = h("select", { onchange: () => void start(select.value) });
  const marks = new VectorSource();
  const markLayer = canvas.overlay(marks, 90, { style: (feature) => feature.get("look") as Style });
  let end = (): void => undefined;
  let wanted = "";
  let analyses: readonly Analysis[] = [];

  async function readChoices(): Promise<void> {
    const [decided, maps, made] = await Promise.all([
      get<{ versions: Semantics[] }>(`v1/maps/${map.id}/semantics/versions`),
      listMaps(),
      get<{ analyses: Analysis[] }>(`v1/maps/${map.id}/analyses`),
    ]);
    analyses = made.analyses;
    const versions = decided.versions.filter(({ version }) => version !== labels.inForce.version);
    const others = maps.filter(({ id, analysisId }) => id !== map.id && analysisId);
    const ofSite = (one: MapView): number => (one.site === map.site ? 0 : 1);
    others.sort((left, right) => ofSite(left) - ofSite(right));
    replace(
      select,
      h("option", { value: "" }, t("chooseComparison")),
      h(
        "optgroup",
        { label: t("versions") },
        ...versions.map(({ version, created }) =>
          h("option", { value: `version ${version}` }, t("versionOf", { version, moment: moment(created) })),
        ),
        labels.inForce.version > 0 && h("option", { value: "version 0" }, t("suggestionVersion")),
      ),
      h(
        "optgroup",
        { label: t("proposals") },
        ...analyses
          .filter(({ inForce }) => !inForce)
          .map(({ id, created }) =>
            h("option", { value: `analysis ${id}` }, t("analysisOf", { moment: moment(created) })),
          ),
      ),
      h(
        "optgroup",
        { label: t("otherMaps") },
        ...others.map((one) => h("option", { value: `map ${one.id}` }, `${one.name}, ${moment(one.created)}`)),
      ),
    );
  }

  async function start(value: string): Promise<void> {
    wanted = value;
    stop();
    clear(problems);
    const [kind, id = ""] = value.split(" ");
    if (kind === "") return;
    if (kind === "analysis") return ask(id);
    await run(value, kind === "map" ? compareMap(workspace, id) : compareVersion(workspace, Number(id)));
  }

  /** Another analysis is put in force first: that is asked, for everybody sees it. */
  function ask(id: string): void {
    const [other, inForce] = [analyses.find((one) => one.id === id), analyses.find((one) => one.inForce)];
    if (!other || !inForce) return;
    const options = differentOptions(inForce.options, other.options);
    const activate = async (): Promise<void> => {
      await run(`analysis ${id}`, compareAnalysis(workspace, other, inForce));
      await readChoices();
    };
    replace(
      answer,
      options.length > 0 && h("p", {}, t("differentOptions")),
      h("ul", {}, ...options.map(({ path, before, now }) => h("li", {}, `${path}: ${before} → ${now}`))),
      h("p", {}, t("activateMeaning")),
      button(t("activate"), () => void activate().catch(failed), { class: "primary" }),
    );
  }

  async function run(value: string, comparing: Promise<Comparison>): Promise<void> {
    replace(answer, t("comparing"));
    try {
      const found = await comparing;
      if (wanted === value) draw(found);
    } catch (error) {
      replace(answer);
      show(problems, error);
    }
  }

  function draw({ layers, name, hasPicture, remarks, groups }: Comparison): void {
    for (const layer of layers) canvas.map.addLayer(layer);
    const right = hasPicture ? [canvas.raster, ...canvas.ownLayers()] : canvas.ownLayers();
    const rightName = hasPicture ? map.name : t("version", { version: labels.inForce.version });
    const endSwipe = swipe(canvas, { left: layers, right, leftName: name, rightName });
    for (const { color, changes } of groups) {
      for (const { position } of changes) {
        if (!position) continue;
        const mark = new Feature(new PointGeometry([...position]));
        mark.set("look", dot(color, 5));
        marks.addFeature(mark);
      }
    }
    replace(answer, ...remarks.map((remark) => h("p", {}, remark)), changeList(groups, fly));
    end = () => {
      endSwipe();
      for (const layer of layers) canvas.map.removeLayer(layer);
      marks.clear();
    };
  }

  function fly([x, y]: Point): void {
    canvas.fit([x - MARGIN, y - MARGIN, x + MARGIN, y + MARGIN], 300);
  }

  function stop(): void {
    end();
    end = () => undefined;
    replace(answer);
  }

  readChoices().catch(failed);
  return {
    element: h(
      "section",
      { "aria-label": t("compare") },
      h("p", {}, h("small", {}, t("compareMeaning"))),
      field(t("compareWith"), select),
      problems,
      answer,
    ),
    close: () => {
      wanted = "";
      stop();
      canvas.remove(markLayer);
    },
  };
}
