/** Maps that were deleted, by whomever, and that the service still keeps: each can be brought back. */

import { button, h, replace } from "../../dom";
import { moment, t } from "../../language";
import { listDeletedMaps, restoreMap } from "../../service/maps";
import type { DeletedMap } from "../../service/types";

export interface DeletedMaps {
  readonly element: HTMLElement;
  /** Asks the service which there are. */
  read(): Promise<void>;
}

export function deletedMaps(restored: () => void, failed: (error: unknown) => void): DeletedMaps {
  const element = h("ul", { class: "deleted", "aria-label": t("deletedMaps"), "aria-live": "polite", hidden: true });

  function line({ id, name, restorableUntil }: DeletedMap): HTMLElement {
    const undo = button(t("undoDeletion"), () => void restoreMap(id).then(restored).catch(failed), {
      "aria-label": t("undoDeletionOf", { name }),
    });
    const until = h("small", {}, t("restorableUntil", { moment: moment(restorableUntil) }));
    return h("li", { class: "card line" }, h("span", {}, t("deletedMap", { name }), " ", until), undo);
  }

  return {
    element,
    read: async () => {
      const maps = await listDeletedMaps();
      element.hidden = maps.length === 0;
      replace(element, ...maps.map(line));
    },
  };
}
