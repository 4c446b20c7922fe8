/** What is to be said of the navigation graph: dead ends, narrow passages, locations that no lane reaches. */

import Feature from "ol/Feature";
import { MultiLineString, Point as PointGeometry } from "ol/geom";
import VectorSource from "ol/source/Vector";
import type Style from "ol/style/Style";

import { button, h, replace, swatch } from "../../../dom";
import { number, t } from "../../../language";
import { COLORS, dot, label, line } from "../../../map/look";
import { get } from "../../../service/request";
import type { GraphReport } from "../../../service/types";
import type { Workspace } from "../workspace";
import { lanesOf, stretch, type Lanes, type Layouts } from "./lanes";

interface Finding {
  readonly text: string;
  readonly position: readonly number[];
  readonly color: string;
  /** The lanes that it is about, by the nodes that they join. */
  readonly lanes: readonly (readonly string[])[];
}

export function graphReport({ map, canvas, failed }: Workspace): { readonly element: HTMLElement; close(): void } {
  const source = new VectorSource();
  const layer = canvas.overlay(source, 65, { style: (feature) => feature.get("look") as Style[] });
  const content = h("div", {});
  const element = h("details", {}, h("summary", {}, t("graphReport")), content);

  async function read(): Promise<void> {
    const [report, layouts] = await Promise.all([
      get<GraphReport>(`v1/maps/${map.id}/graph-report`),
      // Its coordinates are metres of the map frame, its nodes are named as in the report.
      get<Layouts>(`v1/maps/${map.id}/exports/lif.json`),
    ]);
    const lanes = lanesOf(layouts);
    const groups: [string, Finding[]][] = [
      [
        t("unreachableLocations"),
        report.unreachableLocations.map(({ code, detail, position, centre }) => ({
          text: `${code}: ${detail}`,
          position: position ?? centre,
          color: COLORS.chosen,
          lanes: [],
        })),
      ],
      [
        t("deadEnds"),
        report.deadEnds.map(({ lengthM, position, locations, node, meetsAt }) => ({
          text: t("deadEnd", { metres: number(lengthM, 1), count: locations.length }),
          position,
          color: COLORS["storage-access"],
          lanes: stretch(lanes, node, meetsAt ?? null),
        })),
      ],
      [
        t("narrowPassages"),
        report.narrowPassages.map(({ widthM, lengthM, position, lanes }) => ({
          text: t("narrowPassage", { width: number(widthM, 2), metres: number(lengthM, 1) }),
          position,
          color: COLORS.changed,
          lanes,
        })),
      ],
    ];
    source.clear();
    drawLanes(lanes, lanes.pairs, [line("#ffffff", 3), line(COLORS.connected, 1.5)]);
    for (const { lanes: pairs, color } of groups.flatMap(([, findings]) => findings)) {
      drawLanes(lanes, pairs, [line(color, 5)]);
    }
    for (const [, findings] of groups) findings.forEach((finding, index) => draw(finding, index + 1));
    const { numNodes, numEdges, numSubgraphs, pathSuccessRate } = report.figures;
    replace(
      content,
      h(
        "p",
        {},
        t("graphFigures", {
          nodes: numNodes,
          lanes: numEdges,
          parts: numSubgraphs,
          share: number((pathSuccessRate ?? 0) * 100, 1),
        }),
      ),
      ...groups.map(([title, findings]) => group(title, findings)),
      h("a", { href: `v1/maps/${map.id}/graph-report.png`, target: "_blank", rel: "noopener" }, t("asPicture")),
    );
  }

  function drawLanes({ nodes }: Lanes, pairs: readonly (readonly string[])[], look: Style[]): void {
    const ends = pairs.map((pair) => pair.flatMap((name) => (nodes.has(name) ? [[...(nodes.get(name) ?? [])]] : [])));
    const feature = new Feature(new MultiLineString(ends.filter(({ length }) => length === 2)));
    feature.set("look", look);
    source.addFeature(feature);
  }

  function draw({ position, color }: Finding, index: number): void {
    const feature = new Feature(new PointGeometry([...position]));
    feature.set("look", [dot(color, 8), label(String(index))]);
    source.addFeature(feature);
  }

  function group(title: string, findings: readonly Finding[]): HTMLElement {
    const fly = ({ position: [x = 0, y = 0] }: Finding): void => canvas.fit([x - 8, y - 8, x + 8, y + 8], 300);
    const [first] = findings;
    return h(
      "section",
      { class: "list" },
      h("h2", {}, first && swatch(first.color), ` ${title}: ${findings.length}`),
      h(
        "ol",
        {},
        ...findings.map((finding) =>
          h(
            "li",
            {},
            button(finding.text, () => fly(finding)),
          ),
        ),
      ),
    );
  }

  element.addEventListener("toggle", () => {
    layer.setVisible(element.open);
    if (element.open) read().catch(failed);
  });
  return { element, close: () => canvas.remove(layer) };
}
