/** The files that other programs read, each with its options. */

import { button, field, h, replace } from "../../../dom";
import { language, t } from "../../../language";
import { clear, problemBox, show } from "../../../parts/problem";
import { ask, get } from "../../../service/request";
import type { Export } from "../../../service/types";
import { germanExportOptions, germanPurposes } from "../../../texts/exports";
import type { Workspace } from "../workspace";

/** Characters of a text file that are shown before it is downloaded. */
const PREVIEW = 4_000;
const TEXT = /json|yaml|text|csv|xml/;

export function exportList({ map, failed }: Workspace): HTMLElement {
  const list = h("div", {});
  get<{ exports: Export[] }>(`v1/maps/${map.id}/exports`).then(
    ({ exports }) => replace(list, ...exports.map((one) => exportEntry(map.id, one))),
    failed,
  );
  return h("section", { "aria-labelledby": "exports-title" }, h("h2", { id: "exports-title" }, t("exports")), list);
}

/** A German text where the page is in German. */
function german(text: string | undefined): string | undefined {
  return language() === "de" ? text : undefined;
}

function exportEntry(map: string, { name, purpose, mediaType, options }: Export): HTMLElement {
  const problems = problemBox();
  const preview = h("pre", { class: "scroll big", tabindex: 0, hidden: true, "aria-label": t("preview") });
  const values = new Map<string, string>();
  const path = (): string => {
    const query = new URLSearchParams([...values].filter(([, value]) => value !== "")).toString();
    return `v1/maps/${map}/exports/${name}${query && `?${query}`}`;
  };
  const download = h("a", { href: path(), download: name }, t("download"));
  const fields = options.map((option) => {
    const input = h("input", {
      type: "text",
      placeholder: option.example,
      oninput: () => {
        values.set(option.name, input.value.trim());
        download.href = path();
      },
    });
    return field(option.name, input, german(germanExportOptions[option.name]) ?? option.description);
  });
  // A download says nothing when it is refused: it is asked for first.
  const check = async (): Promise<void> => {
    clear(problems);
    try {
      const response = await ask(path(), { headers: { Accept: "*/*" } });
      const text = TEXT.test(mediaType) ? await response.text() : t("noPreview", { type: mediaType });
      preview.hidden = false;
      replace(preview, text.length > PREVIEW ? `${text.slice(0, PREVIEW)}\n…` : text);
    } catch (error) {
      preview.hidden = true;
      show(problems, error);
    }
  };
  return h(
    "details",
    {},
    h("summary", {}, h("strong", {}, name), " ", h("small", {}, german(germanPurposes[name]) ?? purpose)),
    ...fields,
    problems,
    h(
      "div",
      { class: "line" },
      download,
      button(t("preview"), () => void check()),
    ),
    preview,
  );
}
