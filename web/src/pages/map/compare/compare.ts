/** Comparing a map with an earlier version of its labels or with another map: side by side under a divider, and as a list. */

import Feature from "ol/Feature";
import { Point as PointGeometry } from "ol/geom";
import VectorSource from "ol/source/Vector";
import type Style from "ol/style/Style";

import { field, h, replace } from "../../../dom";
import { moment, t } from "../../../language";
import type { Point } from "../../../map/frame";
import { dot } from "../../../map/look";
import { clear, problemBox, show } from "../../../parts/problem";
import { listMaps } from "../../../service/maps";
import { get } from "../../../service/request";
import type { MapView, Semantics } from "../../../service/types";
import type { OpenTool, Tool, Workspace } from "../workspace";
import { changeList } from "./change_list";
import type { Comparison } from "./comparison";
import { compareMap } from "./map_comparison";
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

  async function readChoices(): Promise<void> {
    const [decided, maps] = await Promise.all([
      get<{ versions: Semantics[] }>(`v1/maps/${map.id}/semantics/versions`),
      listMaps(),
    ]);
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
    replace(answer, t("comparing"));
    try {
      const found = await (kind === "map" ? compareMap(workspace, id) : compareVersion(workspace, Number(id)));
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
