/** Another map of the same site beside this one, laid on it. The older of the two is the one before. */

import VectorImageLayer from "ol/layer/VectorImage";

import { moment, number, t } from "../../../language";
import { Collections } from "../../../map/collections";
import { coordinatesOf } from "../../../map/coordinates";
import type { Point } from "../../../map/frame";
import { rowOf } from "../../../map/geojson";
import { area } from "../../../map/look";
import { moved, movedBack } from "../../../map/motion";
import { pictureOf, rasterLayer } from "../../../map/raster";
import { get } from "../../../service/request";
import type { Diagnostics, MapComparison, MapView, Semantics } from "../../../service/types";
import type { Workspace } from "../workspace";
import type { Comparison } from "./comparison";
import { readColors } from "./label_colors";
import { locationGroups } from "./location_changes";

export async function compareMap({ map, canvas }: Workspace, id: string): Promise<Comparison> {
  const other = await get<MapView>(`v1/maps/${id}`);
  const isEarlier = other.created < map.created;
  const [before, now] = isEarlier ? [other, map] : [map, other];
  const [{ alignment, locations }, { frame }, { ruleSet }] = await Promise.all([
    get<MapComparison>(`v1/maps/${before.id}/compare/${now.id}`),
    get<Diagnostics>(`v1/maps/${id}/diagnostics`),
    get<Semantics>(`v1/maps/${id}/semantics`),
  ]);
  const colors = await readColors(ruleSet);
  // The alignment leads from the map now to the one before.
  const ofOther = (point: Point): Point => (isEarlier ? movedBack(alignment, point) : moved(alignment, point));
  const coordinates = coordinatesOf(other.georeference);
  const collections = new Collections(id, { ...coordinates, toMap: (point) => ofOther(coordinates.toMap(point)) });
  const faces = new VectorImageLayer({
    source: await collections.read("faces"),
    imageRatio: 2,
    zIndex: 10,
    style: (face) => area(colors.of(rowOf(face)["label"])),
  });
  const placed = pictureOf({ frame, width: other.width, height: other.height });
  const picture = rasterLayer(
    { ...placed, place: (pixel) => ofOther(placed.place(pixel)) },
    `v1/maps/${id}/image.png`,
    canvas.projection,
  );
  const quality = alignment.quality;
  return {
    layers: [picture, faces],
    name: `${other.name}, ${moment(other.created)}`,
    nameInForce: map.name,
    hasPicture: true,
    remarks: [
      t("comparedFromTo", { before: before.name, now: now.name }),
      ...(quality
        ? [
            t("alignedBy", {
              residual: number(quality.residualM * 100, 1),
              agreement: number(quality.agreement * 100),
            }),
            ...(quality.ambiguous ? [t("alignmentAmbiguous")] : []),
          ]
        : []),
      t("locationsUnchanged", { count: locations.unchanged }),
    ],
    // Centres lie in the frame of the map before.
    groups: locationGroups(locations, isEarlier ? ofOther : (point) => point),
  };
}
