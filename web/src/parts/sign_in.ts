/** Asks for a key, where the service needs one. */

import { field, h } from "../dom";
import { t } from "../language";
import { signIn } from "../service/session";
import { clear, problemBox, show } from "./problem";

let isAsking = false;

/** Opens the dialog, once; tells when somebody has signed in. */
export function askForKey(signedIn: () => void): void {
  if (isAsking) return;
  isAsking = true;
  const problems = problemBox();
  const input = h("input", { type: "password", autocomplete: "off", required: true, spellcheck: "false" });

  async function enter(): Promise<void> {
    clear(problems);
    await signIn(input.value.trim());
    dialog.close();
    signedIn();
  }

  const form = h(
    "form",
    {
      onsubmit: (event: Event) => {
        event.preventDefault();
        enter().catch((error: unknown) => show(problems, error));
      },
    },
    h("h2", { id: "sign-in-title" }, t("signInTitle")),
    field(t("key"), input, t("keyMeaning")),
    problems,
    h("div", { class: "actions" }, h("button", { type: "submit", class: "primary" }, t("signIn"))),
  );
  const dialog = h("dialog", { "aria-labelledby": "sign-in-title" }, form);
  dialog.addEventListener("close", () => {
    isAsking = false;
    dialog.remove();
  });
  document.body.append(dialog);
  dialog.showModal();
}
