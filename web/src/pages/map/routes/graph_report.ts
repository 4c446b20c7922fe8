/** What is to be said of the navigation graph: dead ends, narrow passages, locations that no lane reaches. */

import Feature from "ol/Feature";
import { Point as PointGeometry } from "ol/geom";
import VectorSource from "ol/source/Vector";
import type Style from "ol/style/Style";

import { button, h, replace } from "../../../dom";
import { number, t } from "../../../language";
import { COLORS, dot, label } from "../../../map/look";
import { get } from "../../../service/request";
import type { GraphReport } from "../../../service/types";
import type { Workspace } from "../workspace";

interface Finding {
  readonly text: string;
  readonly position: readonly number[];
  readonly color: string;
}

export function graphReport({ map, canvas, failed }: Workspace): { readonly element: HTMLElement; close(): void } {
  const source = new VectorSource();
  const layer = canvas.overlay(source, 65, { style: (feature) => feature.get("look") as Style[] });
  const content = h("div", {});
  const element = h("details", {}, h("summary", {}, t("graphReport")), content);

  async function read(): Promise<void> {
    const report = await get<GraphReport>(`v1/maps/${map.id}/graph-report`);
    const groups: [string, Finding[]][] = [
      [
        t("unreachableLocations"),
        report.unreachableLocations.map(({ code, detail, position, centre }) => ({
          text: `${code}: ${detail}`,
          position: position ?? centre,
          color: COLORS.chosen,
        })),
      ],
      [
        t("deadEnds"),
        report.deadEnds.map(({ lengthM, position, locations }) => ({
          text: t("deadEnd", { metres: number(lengthM, 1), count: locations.length }),
          position,
          color: COLORS["storage-access"],
        })),
      ],
      [
        t("narrowPassages"),
        report.narrowPassages.map(({ widthM, lengthM, position }) => ({
          text: t("narrowPassage", { width: number(widthM, 2), metres: number(lengthM, 1) }),
          position,
          color: COLORS.connected,
        })),
      ],
    ];
    source.clear();
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

  function draw({ position, color }: Finding, index: number): void {
    const feature = new Feature(new PointGeometry([...position]));
    feature.set("look", [dot(color, 8), label(String(index))]);
    source.addFeature(feature);
  }

  function group(title: string, findings: readonly Finding[]): HTMLElement {
    const fly = ({ position: [x = 0, y = 0] }: Finding): void => canvas.fit([x - 8, y - 8, x + 8, y + 8], 300);
    return h(
      "section",
      { class: "list" },
      h("h2", {}, `${title}: ${findings.length}`),
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
