/** An earlier version of labels and corrections beside the one in force. */

import { getCenter } from "ol/extent";
import type Feature from "ol/Feature";
import VectorImageLayer from "ol/layer/VectorImage";
import VectorSource from "ol/source/Vector";

import { moment, t } from "../../../language";
import { featureOf, rowOf, type GeoJsonFeature } from "../../../map/geojson";
import type { Point } from "../../../map/frame";
import { area, COLORS } from "../../../map/look";
import { get } from "../../../service/request";
import type { LabelComparison, Semantics } from "../../../service/types";
import type { Workspace } from "../workspace";
import type { Change, ChangeGroup } from "../change_list";
import type { Comparison } from "./comparison";
import { readColors } from "./label_colors";
import { locationGroups } from "./location_changes";

/** What is read of the changes from a version to another. */
interface VersionChanges {
  readonly features: readonly GeoJsonFeature[];
}

const CHANGES = [
  ["added", "facesAdded", COLORS.added],
  ["removed", "facesRemoved", COLORS.removed],
  ["reshaped", "facesReshaped", COLORS.changed],
  ["relabelled", "facesRelabelled", COLORS.chosen],
] as const;

export async function compareVersion(
  { map, labels, collections, coordinates }: Workspace,
  version: number,
): Promise<Comparison> {
  const path = `v1/maps/${map.id}`;
  const query = new URLSearchParams({ since: String(version), crs: coordinates.crs, limit: "10000" });
  const [semantics, locations, changes, faces] = await Promise.all([
    get<Semantics>(`${path}/semantics/versions/${version}`),
    get<LabelComparison>(`${path}/changes?since=${version}`),
    get<VersionChanges>(`${path}/semantics/versions/${labels.inForce.version}/changes?${query}`),
    collections.read("faces"),
  ]);
  const colors = await readColors(semantics.ruleSet);
  const different = changes.features.map((feature) => featureOf("faces", feature, coordinates.toMap));
  const layer = new VectorImageLayer({
    source: new VectorSource({ features: facesBefore(faces.getFeatures(), different) }),
    imageRatio: 2,
    zIndex: 10,
    style: (face) => area(colors.of(labelBefore(face as Feature))),
  });
  const names = new Map([...colors.labels, ...labels.ruleSet.labels].map(({ id, name }) => [id, name]));
  const name = (id: unknown): string => names.get(String(id)) ?? "–";
  return {
    layers: [layer],
    name: t("versionOf", { version, moment: moment(semantics.created) }),
    hasPicture: false,
    remarks: [],
    groups: [...faceGroups(different, name), ...locationGroups(locations.locations, (position) => position)],
  };
}

/** The faces of the version before: those of now without what is new, and what was there instead. */
function facesBefore(now: readonly Feature[], different: readonly Feature[]): Feature[] {
  const isNew = new Set(different.filter((face) => !isOfBefore(face)).map((face) => rowOf(face)["face"]));
  const before = [
    ...now.filter((face) => !isNew.has(rowOf(face)["id"])),
    ...different.filter((face) => isOfBefore(face) || rowOf(face)["change"] === "relabelled"),
  ];
  // Copies have no id: what was there before has none, and ids in a source are different.
  return before.map((face) => face.clone());
}

function isOfBefore(face: Feature): boolean {
  return rowOf(face)["isBefore"] === true;
}

function labelBefore(face: Feature): unknown {
  const row = rowOf(face);
  return "previousLabel" in row ? row["previousLabel"] : row["label"];
}

function faceGroups(different: readonly Feature[], name: (label: unknown) => string): ChangeGroup[] {
  return CHANGES.map(([kind, title, color]) => ({
    title: t(title),
    color,
    changes: different
      .filter((face) => rowOf(face)["change"] === kind && isOfBefore(face) === (kind === "removed"))
      .map((face): Change => {
        const { face: now, previousFace, label, previousLabel } = rowOf(face);
        const [x = 0, y = 0] = getCenter(face.getGeometry()?.getExtent() ?? []);
        const text = t("changedFace", {
          key: String(now ?? previousFace),
          before: name(previousLabel),
          after: name(label),
        });
        return { text, position: [x, y] satisfies Point };
      }),
  }));
}
