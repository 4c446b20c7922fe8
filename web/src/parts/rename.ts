/** Another name for a map. Where somebody else changed the map meanwhile, that is told, and what was typed stays. */

import { button, field, h, replace } from "../dom";
import { t } from "../language";
import { renameMap } from "../service/maps";
import { getTagged, Refused } from "../service/request";
import type { MapView } from "../service/types";
import { clear, problemBox, show } from "./problem";

/** Opens the dialog; tells the map under its new name. */
export async function rename(id: string, renamed: (map: MapView) => void): Promise<void> {
  const path = `v1/maps/${id}`;
  let read = await getTagged<MapView>(path);
  const problems = problemBox();
  const input = h("input", { type: "text", value: read.body.name, maxlength: 200, autocomplete: "off" });

  async function save(): Promise<void> {
    clear(problems);
    try {
      const { body } = await renameMap(id, input.value.trim(), read.tag);
      dialog.close();
      renamed(body);
    } catch (error) {
      if (!(error instanceof Refused && error.status === 412)) throw error;
      read = await getTagged<MapView>(path);
      replace(problems, h("div", { class: "problem" }, h("p", {}, t("changedMeanwhile", { name: read.body.name }))));
    }
  }

  const form = h(
    "form",
    {
      onsubmit: (event: Event) => {
        event.preventDefault();
        save().catch((error: unknown) => show(problems, error));
      },
    },
    h("h2", { id: "rename-title" }, t("renameTitle")),
    field(t("name"), input),
    problems,
    h(
      "div",
      { class: "actions" },
      button(t("cancel"), () => dialog.close()),
      h("button", { type: "submit", class: "primary" }, t("rename")),
    ),
  );
  const dialog = h("dialog", { "aria-labelledby": "rename-title" }, form);
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
  input.select();
}
