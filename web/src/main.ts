/** The page: a header, and below it what the address names. */

import "./style/base.css";
import * as address from "./address";
import { button, choice, h, replace } from "./dom";
import { choose, language, t, type Language } from "./language";
import { mapsPage } from "./pages/maps/maps_page";
import { askForKey } from "./parts/sign_in";
import { onConnection } from "./service/connection";
import { onSignedOut } from "./service/request";
import { isSignedIn, signOut } from "./service/session";

const connection = h("div", { class: "connection", role: "status" });
const main = h("main", { id: "main" });
/** Ends what the shown page goes on doing: streams, listeners. */
let leave = (): void => undefined;
let shown = "";

function header(): HTMLElement {
  const languages = [
    ["en", "English"],
    ["de", "Deutsch"],
  ] as const;
  const chosen = choice(
    languages,
    language(),
    (value) => {
      choose(value as Language);
      begin();
    },
    { "aria-label": t("language") },
  );
  return h(
    "header",
    { class: "top" },
    h(
      "a",
      { href: "#main", class: "skip", onclick: (event: Event) => (event.preventDefault(), main.focus()) },
      t("skip"),
    ),
    h("a", { href: "#/", class: "brand" }, "stillage"),
    h("a", { href: "#/" }, t("maps")),
    h("a", { href: "docs/", class: "right" }, t("reference")),
    isSignedIn() && button(t("signOut"), () => void signOut().then(begin)),
    chosen,
  );
}

async function show(): Promise<void> {
  // What was asked on the page before needs no answer any more.
  for (const dialog of document.querySelectorAll("dialog")) dialog.close();
  // What is open on a map is no other page: the map follows the address by itself.
  const { map } = address.read(location.hash);
  const wanted = map ?? "maps";
  if (wanted === shown) return;
  shown = wanted;
  leave();
  leave = () => undefined;
  if (map === null) {
    const page = mapsPage();
    leave = page.leave;
    replace(main, page.element);
    return;
  }
  // The drawing of maps is loaded with the first map.
  const { mapPage } = await import("./pages/map/map_page");
  if (shown !== wanted) return;
  const page = mapPage(map);
  leave = page.leave;
  replace(main, page.element);
}

function begin(): void {
  document.documentElement.lang = language();
  main.tabIndex = -1;
  replace(document.body, header(), connection, main);
  shown = "";
  void show();
}

onSignedOut(() => askForKey(begin));
onConnection((isGone) => replace(connection, isGone && t("connecting")));
addEventListener("hashchange", () => void show());
begin();
