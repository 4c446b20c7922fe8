/** A question before something that is lost. */

import { button, h } from "../dom";
import { t } from "../language";

/** Asks; true where the person agrees. */
export function confirm(question: string, detail: string, agree: string): Promise<boolean> {
  return new Promise((answer) => {
    const dialog = h(
      "dialog",
      { "aria-labelledby": "question" },
      h("h2", { id: "question" }, question),
      h("p", {}, detail),
      h(
        "div",
        { class: "actions" },
        button(t("keep"), () => dialog.close("")),
        button(agree, () => dialog.close("yes"), { class: "danger" }),
      ),
    );
    dialog.addEventListener("close", () => {
      dialog.remove();
      answer(dialog.returnValue === "yes");
    });
    document.body.append(dialog);
    dialog.showModal();
  });
}
