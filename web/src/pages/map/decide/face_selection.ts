/** Faces chosen on the map, by click or by a box, and the label that they get instead of their category's. */

import { containsCoordinate, getCenter } from "ol/extent";
import type Feature from "ol/Feature";
import DragBox from "ol/interaction/DragBox";

import { button, h, swatch } from "../../../dom";
import { t } from "../../../language";
import { pointInside, rowOf } from "../../../map/geojson";
import type { Workspace } from "../workspace";

export interface FaceSelection {
  element(): HTMLElement;
  size(): number;
  click(features: readonly Feature[]): void;
  key(event: KeyboardEvent): void;
  onChange(listener: () => void): void;
  close(): void;
}

export function faceSelection({ labels, canvas, collections }: Workspace): FaceSelection {
  const chosen = new Map<number, Feature>();
  let isBox = false;
  let tell = (): void => undefined;
  const box = new DragBox({ className: "selection-box" });
  box.on("boxend", () => {
    // Faces whose middle lies in the box: long aisles that only reach into it are not meant.
    const extent = box.getGeometry().getExtent();
    for (const face of collections.source("faces").getFeaturesInExtent(extent)) {
      const middle = getCenter(face.getGeometry()?.getExtent() ?? []);
      if (containsCoordinate(extent, middle)) chosen.set(Number(rowOf(face)["id"]), face);
    }
    changed();
  });

  function changed(): void {
    canvas.chosen.clear();
    canvas.chosen.addFeatures([...chosen.values()].map((face) => face.clone()));
    tell();
  }

  function clear(): void {
    chosen.clear();
    changed();
  }

  function setBox(wanted: boolean): void {
    isBox = wanted;
    if (isBox) canvas.map.addInteraction(box);
    else canvas.map.removeInteraction(box);
    tell();
  }

  /** Gives the chosen faces a label; null that of their category. */
  function label(wanted: string | null): void {
    const [overrides, places] = [{ ...labels.draft.overrides }, { ...labels.draft.places }];
    const inForce = new Set(labels.inForce.overrides.map(({ face }) => face));
    for (const [id, face] of chosen) {
      const inside = pointInside(face);
      if ((wanted === null && !inForce.has(id)) || !inside) {
        delete overrides[id];
        delete places[id];
      } else {
        overrides[id] = wanted;
        places[id] = inside;
      }
    }
    labels.draft = { ...labels.draft, overrides, places };
    clear();
  }

  function element(): HTMLElement {
    const drafted = Object.keys(labels.draft.overrides).length;
    return h(
      "section",
      { "aria-label": t("singleFaces") },
      h("h2", {}, t("singleFaces")),
      h(
        "div",
        { class: "line" },
        button(t("selectByBox"), () => setBox(!isBox), { "aria-pressed": String(isBox), id: "select-by-box" }),
        h("span", { role: "status" }, chosen.size > 0 ? t("facesChosen", { count: chosen.size }) : t("chooseFaces")),
        chosen.size > 0 && button(t("none"), clear),
      ),
      chosen.size > 0 &&
        h(
          "div",
          { class: "line" },
          ...labels.ruleSet.labels.map((one, index) => {
            const act = button(`${index + 1} ${one.name}`, () => label(one.id));
            act.prepend(swatch(one.color), " ");
            return act;
          }),
          button(t("asCategory"), () => label(null)),
        ),
      drafted > 0 && h("p", {}, t("facesDrafted", { count: drafted })),
    );
  }

  return {
    element,
    size: () => chosen.size,
    click: (features) => {
      const face = features.find((feature) => String(feature.getId()).startsWith("faces/"));
      if (!face) return;
      const id = Number(rowOf(face)["id"]);
      if (!chosen.delete(id)) chosen.set(id, face);
      changed();
      document.getElementById(`category-${String(rowOf(face)["category"])}`)?.scrollIntoView({ block: "nearest" });
    },
    key: (event) => {
      const wanted = labels.ruleSet.labels[Number(event.key) - 1];
      if (event.key === "Escape") clear();
      else if (wanted && chosen.size > 0) label(wanted.id);
    },
    onChange: (listener) => void (tell = listener),
    close: () => {
      canvas.chosen.clear();
      canvas.map.removeInteraction(box);
    },
  };
}
