/** Comparing a map with an earlier version of its labels, another analysis or another map: under a divider, and as a list. */

import Feature from "ol/Feature";
import { Point as PointGeometry } from "ol/geom";
import VectorSource from "ol/source/Vector";
import type Style from "ol/style/Style";

import * as address from "../../../address";
import { field, h, replace } from "../../../dom";
import { moment, t } from "../../../language";
import type { Point } from "../../../map/frame";
import { dot } from "../../../map/look";
import { clear, problemBox, show } from "../../../parts/problem";
import { listMaps } from "../../../service/maps";
import { get } from "../../../service/request";
import type { Analysis, MapView, Semantics } from "../../../service/types";
import { wayBack } from "../analyses/activation";
import { changeList } from "../change_list";
import type { OpenTool, Tool, Workspace } from "../workspace";
import { compareAnalysis } from "./analysis_comparison";
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
  const notice = h("div", { role: "status" });
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
    remember(value);
    const [kind, id = ""] = value.split(" ");
    if (kind === "analysis") return startAnalysis(value, id);
    if (kind !== "")
      await run(value, kind === "map" ? compareMap(workspace, id) : compareVersion(workspace, Number(id)));
  }

  async function startAnalysis(value: string, id: string): Promise<void> {
    const [other, inForce] = [analyses.find((one) => one.id === id), analyses.find((one) => one.inForce)];
    if (!other || !inForce) return;
    const activated = async (): Promise<void> => {
      const undone = (): Promise<void> => (replace(notice), restart(value));
      replace(notice, wayBack(workspace, inForce.id, undone));
      await restart(`analysis ${inForce.id}`);
    };
    await run(value, compareAnalysis(workspace, other, inForce, activated));
  }

  /** Another analysis is in force: the choices are others. */
  async function restart(value: string): Promise<void> {
    await readChoices();
    select.value = value;
    await start(value);
  }

  /** What is compared with is part of the address: whoever has it sees the same. */
  function remember(value: string): void {
    const { tool, view } = address.read(location.hash);
    const now = address.withValue(view, "with", value === "" ? undefined : value);
    history.replaceState(null, "", address.ofMap(map.id, tool, now));
    canvas.target.dispatchEvent(new Event("layerschanged"));
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

  function draw({ layers, name, nameInForce, hasPicture, remarks, groups, actions }: Comparison): void {
    for (const layer of layers) canvas.map.addLayer(layer);
    const right = hasPicture ? [canvas.raster, ...canvas.ownLayers()] : canvas.ownLayers();
    const rightName = nameInForce ?? t("version", { version: labels.inForce.version });
    const endSwipe = swipe(canvas, { left: layers, right, leftName: name, rightName });
    for (const { color, changes } of groups) {
      for (const { position } of changes) {
        if (!position) continue;
        const mark = new Feature(new PointGeometry([...position]));
        mark.set("look", dot(color, 5));
        marks.addFeature(mark);
      }
    }
    const said = remarks.map((remark) => (typeof remark === "string" ? h("p", {}, remark) : remark));
    replace(answer, ...said, actions, changeList(groups, fly));
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

  const begin = async (): Promise<void> => {
    await readChoices();
    const named = address.read(location.hash).view.get("with") ?? "";
    select.value = named;
    if (named !== "" && select.value === named) await start(named);
    else select.value = "";
  };
  begin().catch(failed);
  return {
    element: h(
      "section",
      { "aria-label": t("compare") },
      h("p", {}, h("small", {}, t("compareMeaning"))),
      field(t("compareWith"), select),
      notice,
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
