/** Texts of the list of maps and the form for a new one: English, German. */

import type { Texts } from "./text";

export const mapsTexts = {
  noMaps: ["There is no map yet. Upload the first one.", "Es gibt noch keine Karte. Laden Sie die erste hoch."],
  newMap: ["New map", "Neue Karte"],
  dropHere: ["Choose files, or drop them here", "Dateien wählen oder hier ablegen"],
  dropMeaning: [
    "The picture of the map (PNG, PGM, ...) together with its YAML, or an OccupancyGrid message as JSON or YAML",
    "Das Bild der Karte (PNG, PGM, ...) zusammen mit seiner YAML-Datei, oder eine OccupancyGrid-Nachricht als JSON oder YAML",
  ],
  missingAll: [
    "Choose a picture with its YAML, or a message.",
    "Wählen Sie ein Bild mit seiner YAML-Datei oder eine Nachricht.",
  ],
  missingMetadata: [
    "The YAML is missing that was saved with the picture: it tells resolution and origin.",
    "Es fehlt die YAML-Datei, die mit dem Bild gespeichert wurde: Sie nennt Auflösung und Ursprung.",
  ],
  missingImage: [
    "The picture is missing that the YAML belongs to.",
    "Es fehlt das Bild, zu dem die YAML-Datei gehört.",
  ],
  tooManyFiles: [
    "One map at a time: one picture and one YAML.",
    "Eine Karte nach der anderen: ein Bild und eine YAML-Datei.",
  ],
  name: ["Name", "Name"],
  nameMeaning: ["That of the file when empty", "Der Name der Datei, wenn leer"],
  options: ["Options of the analysis", "Optionen der Analyse"],
  automatic: ["automatic", "automatisch"],
  standard: ["{value} (default)", "{value} (Standard)"],
  upload: ["Upload and analyse", "Hochladen und analysieren"],
  size: ["{width} × {height} m, cells of {cell} m", "{width} × {height} m, Zellen von {cell} m"],
  waiting: ["Waits for its turn", "Wartet auf Ausführung"],
  stage: ["Stage: {name}", "Stufe: {name}"],
  analysed: ["Analysed", "Analysiert"],
  notAnalysed: ["Not analysed", "Nicht analysiert"],
  dismissed: ["The analysis was cancelled", "Die Analyse wurde abgebrochen"],
  failed: ["The analysis failed:", "Die Analyse ist gescheitert:"],
  deleteOne: ["Delete {name}", "{name} löschen"],
  deleteQuestion: ["Delete “{name}”?", "„{name}“ löschen?"],
  deleteMeaning: [
    "The map goes with its analyses, its labels and their versions. It can be brought back for a while.",
    "Die Karte wird mit ihren Analysen, ihren Labels und deren Versionen gelöscht. Eine Zeit lang lässt sie sich zurückholen.",
  ],
  deletedMaps: ["Deleted maps", "Gelöschte Karten"],
  deletedMap: ["“{name}” was deleted.", "„{name}“ wurde gelöscht."],
  restorableUntil: ["It can be brought back until {moment}.", "Bis {moment} lässt sie sich zurückholen."],
  undoDeletion: ["Undo", "Rückgängig"],
  undoDeletionOf: ["Bring back {name}", "{name} zurückholen"],
  rename: ["Rename", "Umbenennen"],
  renameOne: ["Rename {name}", "{name} umbenennen"],
  renameTitle: ["Rename the map", "Karte umbenennen"],
  changedMeanwhile: [
    "Somebody else changed the map meanwhile; it is called “{name}” now. Rename it again to give it your name.",
    "Inzwischen hat jemand anderes die Karte geändert; sie heißt jetzt „{name}“. Benennen Sie erneut um, um Ihren Namen zu vergeben.",
  ],
} as const satisfies Texts;
