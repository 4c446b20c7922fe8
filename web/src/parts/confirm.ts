/** A question before something is done that others see. */

import { button, h } from "../dom";
import { t } from "../language";

/** Asks; true where the person agrees. What is lost by it is kept by the other answer. */
export function confirm(question: string, detail: string, agree: string, isLost = true): Promise<boolean> {
  return new Promise((answer) => {
    const dialog = h(
      "dialog",
      { "aria-labelledby": "question" },
      h("h2", { id: "question" }, question),
      h("p", {}, detail),
      h(
        "div",
        { class: "actions" },
        button(t(isLost ? "keep" : "cancel"), () => dialog.close("")),
        button(agree, () => dialog.close("yes"), { class: isLost ? "danger" : "primary" }),
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
