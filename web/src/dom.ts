/** Elements of the page. Every text becomes a text node: nothing that a user wrote is ever read as markup. */

export type Child = Node | string | number | null | undefined | false;
type Listener = (event: never) => void;
type Properties = Record<string, string | number | boolean | null | undefined | Listener>;

/** An element: names that begin with `on` are listeners, true and false set or leave out an attribute. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (typeof value === "function") {
      element.addEventListener(name.slice(2), value as EventListener);
    } else if (value === true) {
      element.setAttribute(name, "");
    } else if (value !== false && value !== null && value !== undefined) {
      element.setAttribute(name, String(value));
    }
  }
  append(element, children);
  return element;
}

/** Puts children in the place of all that an element has. */
export function replace(element: Element, ...children: Child[]): void {
  element.replaceChildren();
  append(element, children);
}

function append(element: Element, children: Child[]): void {
  for (const child of children) {
    if (child !== null && child !== undefined && child !== false) {
      element.append(child instanceof Node ? child : String(child));
    }
  }
}

/** A button that does something. */
export function button(text: string, act: () => void, properties: Properties = {}): HTMLButtonElement {
  return h("button", { type: "button", onclick: act, ...properties }, text);
}

let fields = 0;

/** A field with its name before it, and what it means below. */
export function field(name: string, input: HTMLElement, meaning?: string): HTMLElement {
  const label = h("label", {}, h("span", { class: "name" }, name), input);
  if (meaning === undefined) return h("div", { class: "field" }, label);
  fields += 1;
  const id = `meaning-${fields}`;
  input.setAttribute("aria-describedby", id);
  return h("div", { class: "field" }, label, h("small", { id }, meaning));
}

/** A choice among values with their names. */
export function choice(
  options: readonly (readonly [value: string, name: string])[],
  chosen: string,
  act: (value: string) => void,
  properties: Properties = {},
): HTMLSelectElement {
  const select = h(
    "select",
    { ...properties, onchange: () => act(select.value) },
    ...options.map(([value, name]) => h("option", { value, selected: value === chosen }, name)),
  );
  return select;
}

/** A square in a colour, beside the name that says what it stands for. */
export function swatch(color: string): HTMLElement {
  const element = h("span", { class: "swatch", "aria-hidden": "true" });
  element.style.backgroundColor = color;
  return element;
}
