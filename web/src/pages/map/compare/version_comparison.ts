/** An earlier version of the labels beside the one in force. */

import { getCenter } from "ol/extent";
import VectorImageLayer from "ol/layer/VectorImage";

import { moment, t } from "../../../language";
import type { Point } from "../../../map/frame";
import { area, COLORS } from "../../../map/look";
import { get } from "../../../service/request";
import type { LabelComparison } from "../../../service/types";
import type { Workspace } from "../workspace";
import type { Comparison } from "./comparison";
import { locationGroups } from "./location_changes";
import { readLabels } from "./saved_labels";

export async function compareVersion({ map, labels, collections }: Workspace, version: number): Promise<Comparison> {
  const path = `v1/maps/${map.id}`;
  const [saved, changes, faces] = await Promise.all([
    readLabels(`${path}/semantics/versions/${version}`),
    get<LabelComparison>(`${path}/changes?since=${version}`),
    collections.read("faces"),
  ]);
  const names = new Map([...saved.labels, ...labels.ruleSet.labels].map(({ id, name }) => [id, name]));
  const layer = new VectorImageLayer({
    source: faces,
    imageRatio: 2,
    zIndex: 10,
    style: (face) => area(saved.colorOf(face)),
  });
  const name = (id: string | null | undefined): string => (id ? (names.get(id) ?? id) : "–");
  const middle = (id: number): Point | undefined => {
    const face = faces.getFeatureById(`faces/${id}`);
    if (!face || Array.isArray(face)) return undefined;
    const [x = 0, y = 0] = getCenter(face.getGeometry()?.getExtent() ?? []);
    return [x, y];
  };
  return {
    layers: [layer],
    name: t("versionOf", { version, moment: moment(saved.semantics.created) }),
    hasPicture: false,
    remarks: [],
    groups: [
      {
        title: t("facesRelabelled"),
        color: COLORS.chosen,
        changes: changes.faces.map(({ face, before, now }) => ({
          text: t("changedFace", { key: face, before: name(before), after: name(now) }),
          position: middle(face),
        })),
      },
      ...locationGroups(changes.locations, (position) => position),
    ],
  };
}
