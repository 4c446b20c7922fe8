/** Deciding labels: by category, by face, by rule set; saved as versions that can be undone. */

import { h, replace } from "../../../dom";
import { t } from "../../../language";
import { renumbered } from "../../../labels/draft";
import type { Point } from "../../../map/frame";
import { rowOf } from "../../../map/geojson";
import { get } from "../../../service/request";
import type { Category } from "../../../service/types";
import type { OpenTool, Tool, Workspace } from "../workspace";
import { carriedNotice } from "./carried_notice";
import { categoryList } from "./category_list";
import { effect } from "./effect";
import { faceSelection } from "./face_selection";
import { historyList } from "./history";
import { ruleSetChoice } from "./rule_set_choice";
import { saveBar } from "./save_bar";

export const decide: Tool = { id: "decide", name: "decide", open };

function open(workspace: Workspace): OpenTool {
  const { map, labels, collections, failed } = workspace;
  const selection = faceSelection(workspace);
  const content = h("div", {});
  const bar = saveBar(workspace, reread);
  const outcome = effect(workspace);
  const element = h(
    "div",
    {},
    h("p", {}, h("small", {}, t("decideMeaning"))),
    content,
    h("div", { class: "bar" }, outcome.element, bar.element),
  );
  let categories: Category[] = [];
  let isClosed = false;

  function show(): void {
    // The focus stays where it was in what is shown anew.
    const focused = document.activeElement?.id;
    const isHistoryOpen = element.querySelector<HTMLDetailsElement>("details.history")?.open ?? false;
    replace(
      content,
      carriedNotice(workspace),
      ruleSetChoice(workspace),
      selection.element(),
      h("h2", {}, t("categories")),
      ...categoryList(workspace, categories, selection),
      historyList(workspace, isHistoryOpen, reread),
    );
    bar.update();
    if (focused) document.getElementById(focused)?.focus();
  }

  /** Reads what follows from labels that are in force now. */
  async function reread(): Promise<void> {
    const [read] = await Promise.all([
      get<{ categories: Category[] }>(`v1/maps/${map.id}/categories`),
      collections.refresh(),
    ]);
    if (isClosed) return;
    const faceAt = ([x, y]: Point): number | undefined => {
      const [face] = collections.source("faces").getFeaturesAtCoordinate([x, y]);
      return face && Number(rowOf(face)["id"]);
    };
    const draft = renumbered(labels.draft, faceAt);
    if (draft !== labels.draft) labels.draft = draft;
    categories = read.categories;
    show();
  }

  const stop = labels.onChange(() => categories.length > 0 && show());
  selection.onChange(show);
  collections.read("faces").then(reread).catch(failed);
  return {
    element,
    click: (_point, features) => selection.click(features),
    key: (event) => selection.key(event),
    close: () => {
      isClosed = true;
      stop();
      outcome.close();
      selection.close();
    },
  };
}
