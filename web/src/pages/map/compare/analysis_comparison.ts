/**
 * Another analysis of the map beside the one that was in force. Only the analysis in force answers: the other one is put in
 * force, and what the map showed before is kept here at the left.
 */

import VectorImageLayer from "ol/layer/VectorImage";
import VectorSource from "ol/source/Vector";

import { moment, t } from "../../../language";
import { rowOf } from "../../../map/geojson";
import type { Point } from "../../../map/frame";
import { area } from "../../../map/look";
import { send } from "../../../service/request";
import type { Analysis } from "../../../service/types";
import type { Workspace } from "../workspace";
import type { Comparison } from "./comparison";
import { changesByCode, type Places } from "./changes_by_code";
import { locationGroups } from "./location_changes";

export async function compareAnalysis(
  { map, labels, collections }: Workspace,
  wanted: Analysis,
  inForce: Analysis,
): Promise<Comparison> {
  const [faces, locations] = await Promise.all([collections.read("faces"), collections.read("locations")]);
  const before = faces.getFeatures().map((face) => {
    const copy = face.clone();
    copy.set("color", labels.colorOf(face), true);
    return copy;
  });
  const placesOf = (): Places =>
    new Map(locations.getFeatures().map((place) => [String(rowOf(place)["code"]), rowOf(place)["centre"] as Point]));
  const placesBefore = placesOf();
  await send("POST", `v1/maps/${map.id}/analyses/${wanted.id}/activate`, undefined);
  await Promise.all([labels.reread(), collections.refresh()]);
  return {
    layers: [
      new VectorImageLayer({
        source: new VectorSource({ features: before }),
        imageRatio: 2,
        zIndex: 10,
        style: (face) => area(String(face.get("color"))),
      }),
    ],
    name: t("analysisOf", { moment: moment(inForce.created) }),
    hasPicture: false,
    remarks: [t("analysisActivated")],
    groups: locationGroups(changesByCode(placesBefore, placesOf()), (position) => position),
  };
}
