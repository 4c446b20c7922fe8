/** Texts of the tool that looks: English, German. */

import type { Texts } from "./text";

export const lookTexts = {
  look: ["Look", "Ansehen"],
  search: ["Search a code or a name", "Code oder Namen suchen"],
  found: ["Found", "Gefunden"],
  foundCount: ["{count} found", "{count} gefunden"],
  measure: ["Measure", "Messen"],
  measureMeaning: [
    "Click along the way; a double click ends it.",
    "Klicken Sie entlang des Weges; ein Doppelklick beendet ihn.",
  ],
  length: ["{metres} m", "{metres} m"],
  showAll: ["Show all", "Alles zeigen"],
  lookMeaning: [
    "Click on the map for all that is known of a place. The address of this page holds the view: share it.",
    "Ein Klick auf die Karte zeigt alles, was über einen Ort bekannt ist. Die Adresse dieser Seite enthält die Ansicht: Sie lässt sich teilen.",
  ],
  mapDocument: ["The map as a document of the API", "Die Karte als Dokument der API"],
  staleCodes: ["Codes to be confirmed: {count}", "Zu bestätigende Codes: {count}"],
  staleCodesMeaning: [
    "These places may be others than the earlier scan knew by their codes. Look at each and confirm it there, or confirm all.",
    "Diese Plätze sind vielleicht andere als die, welche die frühere Aufnahme unter ihren Codes kannte. Sehen Sie jeden an und bestätigen Sie ihn dort, oder bestätigen Sie alle.",
  ],
  confirmAll: ["Confirm all", "Alle bestätigen"],
} as const satisfies Texts;
