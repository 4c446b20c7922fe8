/** Many corrections at once from a GeoJSON file: the racks of a building plan. */

import { field, h, replace } from "../../../dom";
import { t } from "../../../language";
import { clear, problemBox, show } from "../../../parts/problem";
import { ask, Refused } from "../../../service/request";
import type { Corrections } from "../../../corrections/corrections";
import type { Workspace } from "../workspace";

export function importFile(
  { map, coordinates }: Workspace,
  corrections: Corrections,
  imported: () => Promise<void>,
): HTMLElement {
  const problems = problemBox();
  const answer = h("p", { role: "status" });
  const input = h("input", { type: "file", accept: ".geojson,.json", onchange: () => void send(input.files?.[0]) });

  async function send(file: File | undefined): Promise<void> {
    if (!file) return;
    clear(problems);
    replace(answer, t("importing"));
    try {
      const before = corrections.listed.length;
      await post(file);
      await imported();
      replace(answer, t("importedCount", { count: corrections.listed.length - before }));
    } catch (error) {
      replace(answer);
      show(problems, error);
    } finally {
      input.value = "";
    }
  }

  /** Sends the file over the list that is in force; an import changes nothing that somebody else did meanwhile. */
  async function post(file: File): Promise<void> {
    const query = new URLSearchParams({ crs: coordinates.crs });
    const wish = (): Parameters<typeof ask>[1] => ({
      method: "POST",
      body: file,
      headers: { "Content-Type": "application/geo+json", "If-Match": corrections.tag },
    });
    const path = `v1/maps/${map.id}/corrections?${query}`;
    try {
      await ask(path, wish());
    } catch (error) {
      if (!(error instanceof Refused && error.status === 412)) throw error;
      await corrections.reread();
      await ask(path, wish());
    }
  }

  return h(
    "details",
    {},
    h("summary", {}, t("importTitle")),
    field(t("importFile"), input, t("importMeaning")),
    problems,
    answer,
  );
}
