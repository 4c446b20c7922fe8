/** Which layers are shown, how strongly the picture shows through, and what the colours mean. */

import { h, replace, swatch } from "../../dom";
import { t } from "../../language";
import { LAYERS, type LayerKind } from "../../map/layers";
import { WIDE } from "../../map/map_canvas";
import type { Workspace } from "./workspace";

export function layerSwitch(workspace: Workspace): { readonly element: HTMLElement; update(): void } {
  const { canvas, labels } = workspace;
  const list = h("div", {});
  const opacity = h("input", {
    type: "range",
    min: 0,
    max: 100,
    value: 100,
    "aria-label": t("picture"),
    oninput: () => canvas.raster.setOpacity(opacity.valueAsNumber / 100),
  });

  const row = (kind: LayerKind): HTMLElement => {
    const isShown = canvas.isShown(kind.id);
    const box = h("input", {
      type: "checkbox",
      checked: isShown,
      onchange: () => {
        canvas.setShown(kind.id, box.checked);
        canvas.target.dispatchEvent(new Event("layerschanged"));
        update();
        list.querySelector<HTMLInputElement>(`#layer-${kind.id}`)?.focus();
      },
      id: `layer-${kind.id}`,
    });
    const only = kind.legend.length === 1 ? kind.legend[0] : undefined;
    const byLabel = ["faces", "places"].includes(kind.id);
    const entries = byLabel
      ? labels.ruleSet.labels.map((label) => [label.color, label.name] as const)
      : kind.legend.map(([color, name]) => [color, t(name)] as const);
    return h(
      "div",
      {},
      h("label", { class: "line" }, box, t(kind.name), only && swatch(only[0])),
      isShown &&
        !only &&
        h("ul", { class: "legend" }, ...entries.map(([color, name]) => h("li", {}, swatch(color), name))),
    );
  };

  function update(): void {
    replace(list, ...[...LAYERS].reverse().map(row));
  }

  labels.onChange(update);
  const title = h("summary", {}, t("layers"));
  const element = h(
    "details",
    { class: "layers card", open: innerWidth > WIDE },
    title,
    h("label", { class: "line" }, t("picture"), opacity),
    list,
  );
  return { element, update };
}
