/** Texts of the tool that compares: English, German. */

import type { Texts } from "./text";

export const compareTexts = {
  compare: ["Compare", "Vergleichen"],
  compareMeaning: [
    "Compare the map with an earlier version of its labels and corrections, with another analysis, or with another scan of the site. Move the divider over the map; a click on a change shows its place.",
    "Vergleichen Sie die Karte mit einer früheren Version ihrer Labels und Berichtigungen, mit einer anderen Analyse oder mit einer anderen Aufnahme der Anlage. Verschieben Sie den Teiler über der Karte; ein Klick auf eine Änderung zeigt ihren Ort.",
  ],
  compareWith: ["Compare with", "Vergleichen mit"],
  chooseComparison: ["Choose", "Wählen"],
  comparing: ["Comparing …", "Wird verglichen …"],
  versions: ["Versions of labels and corrections", "Versionen von Labels und Berichtigungen"],
  versionOf: ["Version {version}, {moment}", "Version {version}, {moment}"],
  suggestionVersion: ["Version 0, the suggestion", "Version 0, der Vorschlag"],
  otherMaps: ["Other maps", "Andere Karten"],
  proposals: ["Other analyses of this map", "Andere Analysen dieser Karte"],
  swipe: ["Divider between the two, percent of the width", "Teiler zwischen beiden, Prozent der Breite"],
  comparedFromTo: ["From “{before}” to “{now}”", "Von „{before}“ nach „{now}“"],
  alignedBy: [
    "Walls and racks agree to {agreement} %, {residual} cm apart.",
    "Wände und Regale stimmen zu {agreement} % überein, auf {residual} cm.",
  ],
  alignmentAmbiguous: [
    "Another way to lay the two on one another fits nearly as well: look closely.",
    "Die beiden lassen sich fast ebenso gut anders aufeinanderlegen: Sehen Sie genau hin.",
  ],
  locationsUnchanged: ["{count} locations are as they were.", "{count} Lagerplätze sind, wie sie waren."],
  nothingChanged: ["Nothing is different.", "Nichts ist anders."],
  moreChanges: ["and {count} more", "und {count} weitere"],
  facesAdded: ["Faces added", "Neue Flächen"],
  facesRemoved: ["Faces removed", "Entfallene Flächen"],
  facesReshaped: ["Faces with another shape", "Flächen mit anderer Form"],
  facesRelabelled: ["Faces with another label", "Flächen mit anderem Label"],
  locationsAdded: ["Locations added", "Neue Lagerplätze"],
  locationsRemoved: ["Locations removed", "Entfallene Lagerplätze"],
  locationsChanged: ["Locations changed", "Geänderte Lagerplätze"],
  moved: ["moved", "verschoben"],
  relabelled: ["other label", "anderes Label"],
  recoded: ["other code", "anderer Code"],
  filled: ["filled", "gefüllt"],
  emptied: ["emptied", "geleert"],
} as const satisfies Texts;
