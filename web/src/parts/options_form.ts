/** The options of an analysis with their meaning, from the OpenAPI document. What stays empty keeps its default. */

import { choice, field, h, replace } from "../dom";
import { inLanguage, t } from "../language";
import { readOptionFields, saidOptions, written, type OptionField } from "../service/options";
import { optionGroups, optionTexts } from "../texts/options";
import { problemBox, show } from "./problem";

export interface OptionsForm {
  readonly element: HTMLElement;
  /** What was chosen, by path (`group/name`). */
  chosen(): ReadonlyMap<string, unknown>;
  /** Fills the form with whole options; without them, every option has its default. */
  fill(options?: unknown): Promise<void>;
}

/** The form, folded until it is filled or opened. */
export function optionsForm(): OptionsForm {
  let chosen = new Map<string, unknown>();
  const content = h("div", { class: "options" });
  let isFilled = false;
  const element = h("details", {}, h("summary", {}, t("options")), content);

  async function fill(options?: unknown): Promise<void> {
    isFilled = true;
    try {
      const fields = await readOptionFields();
      chosen = saidOptions(fields, options);
      replace(content, ...groups(fields).map(([name, group]) => fieldset(name, group, chosen)));
    } catch (error) {
      isFilled = false;
      const box = problemBox();
      replace(content, box);
      show(box, error);
    }
  }

  element.addEventListener("toggle", () => {
    if (element.open && !isFilled) void fill();
  });
  return { element, chosen: () => chosen, fill };
}

/** Fields by the group that they lie in; those of none first. */
function groups(fields: readonly OptionField[]): [string, OptionField[]][] {
  const groups = new Map<string, OptionField[]>();
  for (const option of fields) {
    const group = option.path.slice(0, -1).join(" ");
    groups.set(group, [...(groups.get(group) ?? []), option]);
  }
  return [...groups];
}

function fieldset(group: string, fields: readonly OptionField[], chosen: Map<string, unknown>): HTMLElement {
  const title = group in optionGroups ? inLanguage(optionGroups[group as keyof typeof optionGroups]) : group;
  const inputs = fields.map((option) => {
    const id = option.path.join("/");
    const texts = optionTexts[id];
    const name = texts ? inLanguage(texts.name) : (option.path.at(-1) ?? "");
    const meaning = texts ? inLanguage(texts.meaning) : option.meaning;
    return field(name, input(option, chosen), `${meaning} (${id})`);
  });
  return h("fieldset", {}, h("legend", {}, title), ...inputs);
}

function input(option: OptionField, chosen: Map<string, unknown>): HTMLElement {
  const path = option.path.join("/");
  const standard = option.standard === "" ? t("automatic") : t("standard", { value: option.standard });
  const set = (text: string, value: unknown): void =>
    void (text === "" ? chosen.delete(path) : chosen.set(path, value));
  const begin = chosen.has(path) ? written(chosen.get(path)) : "";
  if (option.kind === "choice" || option.kind === "switch") {
    const values = option.kind === "switch" ? ["true", "false"] : option.values;
    const options = [["", standard] as const, ...values.map((value) => [value, value] as const)];
    return choice(options, begin, (value) => set(value, option.kind === "switch" ? value === "true" : value));
  }
  const text = h("input", {
    type: option.kind === "number" ? "number" : "text",
    step: "any",
    min: option.minimum,
    max: option.maximum,
    placeholder: standard,
    value: begin,
    oninput: () => set(text.value, option.kind === "number" ? text.valueAsNumber : jsonOrText(text.value)),
  });
  return text;
}

/** Lists are written as JSON; the service says what is wrong with anything else. */
function jsonOrText(text: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch {
    return text;
  }
}
