/** Measuring: a path by clicks, its length while it is drawn. */

import { LineString } from "ol/geom";
import Draw from "ol/interaction/Draw";
import VectorSource from "ol/source/Vector";

import { h, replace } from "../../../dom";
import { number, t } from "../../../language";
import { lengthOf, type Point } from "../../../map/frame";
import { COLORS, line } from "../../../map/look";
import type { Workspace } from "../workspace";

export interface Measuring {
  readonly element: HTMLElement;
  isOn(): boolean;
  /** Begins or ends measuring; tells whether it is on. */
  toggle(): boolean;
  close(): void;
}

export function measuring({ canvas }: Workspace): Measuring {
  const source = new VectorSource();
  const layer = canvas.overlay(source, 60, { style: line(COLORS.chosen, 3) });
  const element = h("p", { role: "status" });
  const draw = new Draw({ source, type: "LineString" });
  let isOn = false;
  draw.on("drawstart", (event) => {
    source.clear();
    event.feature.getGeometry()?.on("change", (change) => {
      const points = (change.target as LineString).getCoordinates() as unknown as Point[];
      replace(element, t("length", { metres: number(lengthOf(points), 2) }));
    });
  });
  return {
    element,
    isOn: () => isOn,
    toggle: () => {
      isOn = !isOn;
      source.clear();
      replace(element, isOn && t("measureMeaning"));
      if (isOn) canvas.map.addInteraction(draw);
      else canvas.map.removeInteraction(draw);
      return isOn;
    },
    close: () => {
      canvas.map.removeInteraction(draw);
      canvas.remove(layer);
    },
  };
}
