/** In which options two analyses differ. */

import { h } from "../../../dom";
import { inLanguage, t } from "../../../language";
import { optionTexts } from "../../../texts/options";
import { differentOptions } from "./different_options";

export function optionList(before: unknown, now: unknown): HTMLElement {
  const different = differentOptions(before, now);
  if (different.length === 0) return h("p", {}, t("sameOptions"));
  const name = (path: string): string => {
    const texts = optionTexts[path];
    return texts ? `${inLanguage(texts.name)} (${path})` : path;
  };
  return h(
    "div",
    {},
    h("p", {}, t("differentOptions")),
    h("ul", {}, ...different.map(({ path, before, now }) => h("li", {}, `${name(path)}: ${before} → ${now}`))),
  );
}
