/** The categories of a map, the largest first: what they look like, what is suggested and why, and the label they get. */

import { button, choice, h, swatch } from "../../../dom";
import { number, t } from "../../../language";
import { rowOf } from "../../../map/geojson";
import type { Category } from "../../../service/types";
import type { Workspace } from "../workspace";
import type { FaceSelection } from "./face_selection";

export function categoryList(
  workspace: Workspace,
  categories: readonly Category[],
  selection: FaceSelection,
): HTMLElement[] {
  const used = categories.filter((category) => category.faces > 0);
  used.sort((left, right) => right.facesAreaM2 - left.facesAreaM2);
  return used.map((category) => card(workspace, category, selection));
}

function card({ labels, collections, canvas }: Workspace, category: Category, selection: FaceSelection): HTMLElement {
  const id = String(category.id);
  const drafted = labels.draft.assignment[id];
  const label = drafted ?? category.label;
  const { suggestion } = category;
  const assign = (wanted: string): void => {
    const assignment = { ...labels.draft.assignment, [id]: wanted };
    if (wanted === category.label) delete assignment[id];
    labels.draft = { ...labels.draft, assignment };
  };
  const options = labels.ruleSet.labels.map((one, index) => [one.id, `${index + 1} ${one.name}`] as const);
  const showFaces = (): void => {
    const faces = collections.source("faces").getFeatures();
    canvas.chosen.clear();
    canvas.chosen.addFeatures(
      faces.filter((face) => rowOf(face)["category"] === category.id).map((face) => face.clone()),
    );
  };
  const element = h(
    "section",
    {
      class: drafted === undefined ? "category" : "category changed",
      id: `category-${id}`,
      tabindex: 0,
      "aria-label": t("category", { id }),
      onfocus: showFaces,
      onkeydown: (event: KeyboardEvent) => {
        const wanted = labels.ruleSet.labels[Number(event.key) - 1];
        if (event.target !== element || !wanted || selection.size() > 0) return;
        event.stopPropagation();
        assign(wanted.id);
      },
    },
    h(
      "div",
      { class: "line" },
      swatch(labels.color(label)),
      h("strong", {}, t("category", { id })),
      choice(options, label, assign, { id: `label-${id}`, "aria-label": t("labelOfCategory", { id }) }),
      drafted !== undefined && button(t("takeBack"), () => assign(category.label)),
    ),
    h("p", {}, t("categorySize", { faces: category.faces, area: number(category.facesAreaM2, 0) })),
    h(
      "p",
      {},
      t("suggested", {
        label: labels.label(suggestion.label)?.name ?? suggestion.label,
        percent: number(suggestion.confidence * 100),
      }),
      suggestion.label !== label &&
        suggestion.label !== category.label &&
        button(t("take"), () => assign(suggestion.label)),
    ),
    h("details", {}, h("summary", {}, t("why")), h("p", {}, h("small", {}, suggestion.reason))),
  );
  return element;
}
