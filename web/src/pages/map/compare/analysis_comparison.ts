/** Another analysis of the map beside the one in force, as it would answer. Nothing changes for anybody by comparing. */

import VectorImageLayer from "ol/layer/VectorImage";
import VectorSource from "ol/source/Vector";

import { moment, t } from "../../../language";
import { featureOf, rowOf, type GeoJsonFeature } from "../../../map/geojson";
import { area } from "../../../map/look";
import { get } from "../../../service/request";
import type { Analysis, AnalysisComparison } from "../../../service/types";
import { activation } from "../analyses/activation";
import { optionList } from "../analyses/option_list";
import { lostLabels } from "../carried_labels";
import type { Workspace } from "../workspace";
import type { Comparison } from "./comparison";
import { locationGroups } from "./location_changes";

/** `activated` is told once somebody put the analysis in force here. */
export async function compareAnalysis(
  workspace: Workspace,
  other: Analysis,
  inForce: Analysis,
  activated: () => Promise<void>,
): Promise<Comparison> {
  const { map, labels, coordinates } = workspace;
  const path = `v1/maps/${map.id}/analyses/${other.id}`;
  const query = new URLSearchParams({ crs: coordinates.crs, properties: "label" });
  const [analysis, { faces, locations }, drawn] = await Promise.all([
    get<Analysis>(path),
    get<AnalysisComparison>(`${path}/changes`),
    get<{ features: GeoJsonFeature[] }>(`${path}/faces?${query}`),
  ]);
  const features = drawn.features.map((feature) => featureOf("faces", feature, coordinates.toMap));
  const name = (label: string): string => labels.label(label)?.name ?? label;
  const carried = analysis.wouldCarry;
  return {
    layers: [
      new VectorImageLayer({
        source: new VectorSource({ features }),
        imageRatio: 2,
        zIndex: 10,
        style: (face) => area(labels.color(String(rowOf(face)["label"]))),
      }),
    ],
    name: t("analysisOf", { moment: moment(other.created) }),
    nameInForce: t("analysisInForceOf", { moment: moment(inForce.created) }),
    hasPicture: false,
    remarks: [
      optionList(inForce.options, other.options),
      t("wouldChange"),
      t("facesOfProposal", { ...faces }),
      t("locationsUnchanged", { count: locations.unchanged }),
      ...(carried ? [t("wouldKeep", { kept: carried.kept, lost: carried.lost.length })] : []),
    ],
    groups: [
      ...(carried ? [lostLabels(carried, t("labelsLost"), name)] : []),
      ...locationGroups(locations, (position) => position),
    ],
    actions: activation(workspace, other.id, activated),
  };
}
