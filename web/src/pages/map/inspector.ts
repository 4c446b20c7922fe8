/** All that is known of what was chosen, feature by feature, with a link to its JSON. */

import type Feature from "ol/Feature";

import { button, h, replace } from "../../dom";
import { number, t } from "../../language";
import { confirmCodes } from "../../service/codes";
import { rowOf } from "../../map/geojson";
import type { Collections } from "../../map/collections";
import type { MapCanvas } from "../../map/map_canvas";
import { propertyTitles } from "../../map/property_titles";
import { addressOf, featureName } from "./feature_name";

export function inspector(
  map: string,
  canvas: MapCanvas,
  collections: Collections,
  failed: (error: unknown) => void,
): { readonly element: HTMLElement; choose(features: readonly Feature[]): void } {
  const element = h("aside", { class: "inspector card", "aria-label": t("properties"), hidden: true });

  function choose(features: readonly Feature[]): void {
    canvas.chosen.clear();
    element.hidden = features.length === 0;
    const [first] = features;
    if (first) canvas.chosen.addFeature(first.clone());
    replace(
      element,
      button("×", () => choose([]), { class: "close", "aria-label": t("close") }),
      ...features.map((feature, index) =>
        section(map, feature, index === 0, () => mark(feature), confirmation(feature)),
      ),
    );
  }

  function mark(feature: Feature): void {
    canvas.chosen.clear();
    canvas.chosen.addFeature(feature.clone());
  }

  /** The question whether a code is right, where that is not sure. */
  function confirmation(feature: Feature): HTMLElement | undefined {
    const row = rowOf(feature);
    if (row["stale"] !== true) return undefined;
    const code = String(row["code"]);
    const confirm = async (): Promise<void> => {
      await confirmCodes(map, [code]);
      await collections.refresh();
      const now = collections.source("locations").getFeatureById(`locations/${code}`);
      choose(now && !Array.isArray(now) ? [now] : []);
    };
    return h(
      "p",
      { class: "warning" },
      `${t("staleMeaning")} `,
      button(t("confirmCode", { code }), () => void confirm().catch(failed)),
    );
  }

  return { element, choose };
}

function section(
  map: string,
  feature: Feature,
  isOpen: boolean,
  opened: () => void,
  question?: HTMLElement,
): HTMLElement {
  const [collection, name] = addressOf(feature);
  const row = rowOf(feature);
  const heads = new Map<string, HTMLElement>();
  const line = ([key, value]: [string, unknown]): HTMLElement => {
    // The name by which programs ask for it.
    const head = h("th", { scope: "row", title: key }, key);
    heads.set(key, head);
    return h("tr", {}, head, h("td", {}, readable(value)));
  };
  const isSaid = ([, value]: [string, unknown]): boolean =>
    value !== null && !(Array.isArray(value) && value.length === 0);
  const details = h(
    "details",
    { open: isOpen },
    h("summary", {}, featureName(feature)),
    question,
    h("table", {}, ...Object.entries(row).filter(isSaid).map(line)),
    h(
      "a",
      {
        href: `v1/maps/${map}/collections/${collection}/items/${encodeURIComponent(name)}?f=json`,
        target: "_blank",
        rel: "noopener",
      },
      "JSON",
    ),
  );
  details.addEventListener("toggle", () => details.open && opened());
  // Without titles the names stay.
  propertyTitles(map, collection).then(
    (titles) => heads.forEach((head, key) => replace(head, titles.get(key) ?? key)),
    () => undefined,
  );
  return details;
}

function readable(value: unknown): string {
  if (typeof value === "number") return number(value, Number.isInteger(value) ? 0 : 2);
  if (typeof value === "string") return value;
  if (Array.isArray(value)) return value.map(readable).join(", ");
  return JSON.stringify(value);
}
