/** The codes that wait for a person: which places may be others than the earlier scan knew. */

import { button, h, replace } from "../../../dom";
import { t } from "../../../language";
import { confirmCodes, readRegistry } from "../../../service/codes";
import type { Workspace } from "../workspace";

/** Codes that are listed at once. */
const MOST = 50;
/** Metres around a place that is flown to. */
const MARGIN = 6;

export function staleCodes({ map, collections, canvas, choose, failed }: Workspace): {
  readonly element: HTMLElement;
  close(): void;
} {
  const element = h("div", {});

  async function read(): Promise<void> {
    const { entries } = await readRegistry(map.id);
    const codes = entries.filter(({ state }) => state === "stale").map(({ code }) => code);
    if (codes.length === 0) {
      replace(element);
      return;
    }
    const fly = async (code: string): Promise<void> => {
      const feature = (await collections.read("locations")).getFeatureById(`locations/${code}`);
      if (!feature || Array.isArray(feature)) return;
      const [left = 0, low = 0, right = 0, high = 0] = feature.getGeometry()?.getExtent() ?? [];
      canvas.fit([left - MARGIN, low - MARGIN, right + MARGIN, high + MARGIN], 300);
      choose([feature]);
    };
    const confirmAll = async (): Promise<void> => {
      await confirmCodes(map.id);
      await collections.refresh();
    };
    replace(
      element,
      h(
        "section",
        { class: "list stale", "aria-labelledby": "stale-title" },
        h("h2", { id: "stale-title" }, t("staleCodes", { count: codes.length })),
        h("p", {}, h("small", {}, t("staleCodesMeaning"))),
        h(
          "ul",
          {},
          ...codes.slice(0, MOST).map((code) =>
            h(
              "li",
              {},
              button(code, () => void fly(code).catch(failed)),
            ),
          ),
        ),
        codes.length > MOST && h("p", {}, t("moreChanges", { count: codes.length - MOST })),
      ),
      button(t("confirmAll"), () => void confirmAll().catch(failed)),
    );
  }

  const reread = (): void => void read().catch(failed);
  reread();
  return { element, close: collections.onRefresh(reread) };
}
