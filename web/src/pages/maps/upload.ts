/** The form for a new map: files by choice or by drop, a name, options. */

import { button, field, h, replace } from "../../dom";
import { t } from "../../language";
import { optionsForm } from "../../parts/options_form";
import { clear, problemBox, show } from "../../parts/problem";
import { createMap, type Upload } from "../../service/maps";
import { optionDocument } from "../../service/options";
import type { Job } from "../../service/types";
import { classify, waitsForPicture, type Missing } from "./uploaded_files";

/** The form; tells the job of a map that is uploaded. */
export function uploadForm(uploaded: (job: Job) => void): HTMLElement {
  const files = new Map<string, File>();
  const problems = problemBox();
  const chosen = h("p", { role: "status" });
  const input = h("input", {
    type: "file",
    multiple: true,
    id: "files",
    class: "visually-hidden",
    onchange: () => add(input.files),
  });
  const name = h("input", { type: "text", maxlength: 200, autocomplete: "off" });
  const options = optionsForm();
  const submit = h("button", { type: "submit", class: "primary" }, t("upload"));

  const zone = h(
    "div",
    { class: "drop" },
    input,
    h("label", { for: "files" }, t("dropHere")),
    h("small", {}, t("dropMeaning")),
    chosen,
  );
  zone.addEventListener("dragover", (event) => {
    event.preventDefault();
    zone.classList.add("over");
  });
  zone.addEventListener("dragleave", () => zone.classList.remove("over"));
  zone.addEventListener("drop", (event) => {
    event.preventDefault();
    zone.classList.remove("over");
    add(event.dataTransfer?.files ?? null);
  });

  function add(list: FileList | null): void {
    for (const file of list ?? []) files.set(file.name, file);
    input.value = "";
    void tellFiles();
  }

  async function tellFiles(): Promise<void> {
    clear(problems);
    const names = [...files.keys()].map((file) =>
      h(
        "span",
        { class: "chip" },
        file,
        button("×", () => (files.delete(file), void tellFiles()), { "aria-label": t("remove", { name: file }) }),
      ),
    );
    const found = await ready();
    replace(chosen, ...names, typeof found === "string" && files.size > 0 && t(found));
  }

  async function ready(): Promise<Upload | Missing> {
    const found = classify([...files.values()]);
    if (typeof found === "object" && found.kind === "message" && (await waitsForPicture(found.message)))
      return "missingImage";
    return found;
  }

  async function send(): Promise<void> {
    clear(problems);
    const found = await ready();
    if (typeof found === "string") {
      replace(problems, h("div", { class: "problem" }, h("p", {}, t(found))));
      return;
    }
    submit.disabled = true;
    try {
      const job = await createMap(found, name.value.trim(), optionDocument(options.chosen()));
      files.clear();
      name.value = "";
      void tellFiles();
      uploaded(job);
    } catch (error) {
      show(problems, error);
    } finally {
      submit.disabled = false;
    }
  }

  return h(
    "form",
    {
      class: "upload card",
      "aria-labelledby": "upload-title",
      onsubmit: (event: Event) => {
        event.preventDefault();
        void send();
      },
    },
    h("h2", { id: "upload-title" }, t("newMap")),
    zone,
    field(t("name"), name, t("nameMeaning")),
    options.element,
    problems,
    h("div", { class: "actions" }, submit),
  );
}
