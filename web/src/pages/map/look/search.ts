/** Search for a code or a name; what is chosen is flown to. */

import type Feature from "ol/Feature";

import { button, field, h, replace } from "../../../dom";
import { t } from "../../../language";
import type { Box } from "../../../map/frame";
import { rowOf } from "../../../map/geojson";
import type { Workspace } from "../workspace";
import { matches, type Named } from "./matches";

/** What has a code or a name. */
const SEARCHED = ["locations", "places", "aisles", "rows"];
/** Lines of the list of answers. */
const MOST = 12;
/** Metres around what is flown to. */
const MARGIN = 6;

interface Found extends Named {
  readonly feature: Feature;
}

export function searchField({ collections, canvas, choose, failed }: Workspace): HTMLElement {
  const answers = h("ul", { class: "answers", "aria-label": t("found") });
  const status = h("p", { role: "status", class: "visually-hidden" });
  const input = h("input", { type: "search", autocomplete: "off", oninput: () => void search().catch(failed) });

  async function search(): Promise<void> {
    const sources = await Promise.all(SEARCHED.map((collection) => collections.read(collection)));
    const all: Found[] = sources
      .flatMap((source) => source.getFeatures())
      .map((feature) => ({ feature, names: namesOf(feature) }));
    const found = matches(all, input.value, MOST);
    replace(status, input.value && t("foundCount", { count: found.length }));
    replace(
      answers,
      ...found.map((one) =>
        h(
          "li",
          {},
          button(one.names.join(" · "), () => fly(one.feature)),
        ),
      ),
    );
  }

  function fly(feature: Feature): void {
    const [left = 0, low = 0, right = 0, high = 0] = feature.getGeometry()?.getExtent() ?? [];
    canvas.fit([left - MARGIN, low - MARGIN, right + MARGIN, high + MARGIN] satisfies Box, 400);
    choose([feature]);
  }

  const form = h("form", {
    role: "search",
    onsubmit: (event: Event) => (event.preventDefault(), answers.querySelector("button")?.click()),
  });
  form.append(field(t("search"), input), status, answers);
  return form;
}

function namesOf(feature: Feature): string[] {
  const row = rowOf(feature);
  const [collection = "", id = ""] = String(feature.getId()).split("/");
  const own = row["code"] ?? `${collection.replace(/s$/, "")} ${id}`;
  return [own, row["name"], row["labelName"]].filter((name): name is string => typeof name === "string");
}
