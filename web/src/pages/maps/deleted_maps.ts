/** Maps that were deleted in this browser and that the service still keeps: each can be brought back. */

import { button, h, replace } from "../../dom";
import { t } from "../../language";
import { isKept, restoreMap } from "../../service/maps";
import type { MapView } from "../../service/types";
import { readStored, writeStored } from "../../stored";

const KEY = "stillage.deleted";

interface DeletedMap {
  readonly id: string;
  readonly name: string;
}

export interface DeletedMaps {
  readonly element: HTMLElement;
  /** A map was deleted. */
  add(map: MapView): void;
  /** Asks the service which of them it still keeps. */
  check(): Promise<void>;
}

export function deletedMaps(restored: () => void, failed: (error: unknown) => void): DeletedMaps {
  const element = h("ul", { class: "deleted", "aria-label": t("deletedMaps"), "aria-live": "polite" });
  let maps = readStored<readonly DeletedMap[]>(KEY) ?? [];

  function keep(kept: readonly DeletedMap[]): void {
    maps = kept;
    writeStored(KEY, kept.length > 0 ? kept : undefined);
    element.hidden = kept.length === 0;
    replace(element, ...kept.map(line));
  }

  function line(map: DeletedMap): HTMLElement {
    const restore = async (): Promise<void> => {
      await restoreMap(map.id);
      keep(maps.filter(({ id }) => id !== map.id));
      restored();
    };
    const undo = button(t("undoDeletion"), () => void restore().catch(failed), {
      "aria-label": t("undoDeletionOf", { name: map.name }),
    });
    return h("li", { class: "card line" }, t("deletedMap", { name: map.name }), undo);
  }

  keep(maps);
  return {
    element,
    add: ({ id, name }) => keep([{ id, name }, ...maps]),
    check: async () => {
      const asked = maps;
      const kept = await Promise.all(asked.map(({ id }) => isKept(id)));
      keep(maps.filter((map) => kept[asked.indexOf(map)] ?? true));
    },
  };
}
