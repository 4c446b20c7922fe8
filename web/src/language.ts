/** The language of the page: the reader's choice, else that of the browser. */

import type { Text } from "./texts/text";
import { texts, type TextName } from "./texts/texts";

export type Language = "en" | "de";

const KEY = "stillage.language";

export function language(): Language {
  const chosen = localStorage.getItem(KEY);
  if (chosen === "en" || chosen === "de") return chosen;
  return navigator.language.toLowerCase().startsWith("de") ? "de" : "en";
}

export function choose(chosen: Language): void {
  localStorage.setItem(KEY, chosen);
}

/** A text in the language of the page; `{name}` in it gives way to the value of that name. */
export function t(name: TextName, values: Record<string, string | number> = {}): string {
  const text = inLanguage(texts[name]);
  return text.replace(/\{(\w+)\}/g, (whole, key: string) => (key in values ? String(values[key]) : whole));
}

/** The text of a table in the language of the page. */
export function inLanguage([english, german]: Text): string {
  return language() === "en" ? english : german;
}

/** A number with so many digits after the point, as the language writes it. */
export function number(value: number, digits = 0): string {
  return value.toLocaleString(language(), { minimumFractionDigits: digits, maximumFractionDigits: digits });
}

/** A moment, as the language writes it. */
export function moment(text: string): string {
  return new Date(text).toLocaleString(language(), { dateStyle: "medium", timeStyle: "short" });
}
