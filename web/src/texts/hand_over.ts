/** Texts of the tool that hands over: English, German. */

import type { Texts } from "./text";

export const handOverTexts = {
  handOver: ["Hand over", "Übergeben"],
  locationTable: ["Storage locations", "Lagerplätze"],
  filter: ["Filter", "Filter"],
  allShown: ["{all} locations", "{all} Lagerplätze"],
  rowsShown: [
    "{found} of {all} locations; the first {shown} are shown",
    "{found} von {all} Lagerplätzen; die ersten {shown} sind zu sehen",
  ],
  rowsFound: ["{found} of {all} locations", "{found} von {all} Lagerplätzen"],
  noLocations: [
    "This map has no storage locations. Give its racks a label for storage (Decide), or draw them (Correct).",
    "Diese Karte hat keine Lagerplätze. Geben Sie ihren Regalen ein Label für Lagerung (Entscheiden), oder zeichnen Sie sie (Berichtigen).",
  ],
  columnCode: ["Code", "Code"],
  columnName: ["Name", "Name"],
  columnAisle: ["Aisle", "Gasse"],
  columnBay: ["Bay", "Feld"],
  columnSide: ["Side", "Seite"],
  columnLabel: ["Label", "Label"],
  columnWidthM: ["Width, m", "Breite, m"],
  columnDepthM: ["Depth, m", "Tiefe, m"],
  columnOccupancy: ["Occupancy", "Belegung"],
  sideLeft: ["left", "links"],
  sideRight: ["right", "rechts"],
  downloadCsv: ["Download as CSV", "Als CSV herunterladen"],
  downloadSheet: ["as a spreadsheet", "als Tabelle"],
  exports: ["Files for other programs", "Dateien für andere Programme"],
  download: ["Download", "Herunterladen"],
  preview: ["Preview", "Vorschau"],
  noPreview: [
    "The file can be made; {type} has no preview.",
    "Die Datei lässt sich erzeugen; {type} hat keine Vorschau.",
  ],
  evaluation: ["Compare with a truth", "Mit einer Wahrheit vergleichen"],
  truthFile: ["Truth file", "Datei der Wahrheit"],
  truthMeaning: [
    "GeoJSON in metres of the map, as docs/accuracy.md describes it",
    "GeoJSON in Metern der Karte, wie docs/accuracy.md es beschreibt",
  ],
  suggestedLabels: ["suggested labels", "vorgeschlagene Labels"],
  decidedLabels: ["decided labels", "entschiedene Labels"],
  placesFound: ["Places found", "Gefundene Plätze"],
  placesSystematic: ["Missed, and empty", "Verfehlt und leer"],
  precision: ["Precision", "Genauigkeit"],
  overlap: ["Overlap of {label}", "Überdeckung von {label}"],
  borders: [
    "{found} of the true borders are found, {right} of the borders are right.",
    "{found} der wahren Grenzen sind gefunden, {right} der Grenzen sind richtig.",
  ],
} as const satisfies Texts;
