/** Texts of the map, its layers and their colours: English, German. */

import type { Texts } from "./text";

export const mapTexts = {
  mapCanvas: [
    "The map. Arrow keys move it, plus and minus zoom.",
    "Die Karte. Pfeiltasten verschieben sie, Plus und Minus zoomen.",
  ],
  tools: ["Tools", "Werkzeuge"],
  layers: ["Layers", "Ebenen"],
  picture: ["Picture", "Bild"],
  properties: ["Properties", "Eigenschaften"],
  close: ["Close", "Schließen"],
  faces: ["Faces by label", "Flächen nach Label"],
  edges: ["Edges by cogency", "Kanten nach Bedeutung"],
  places: ["Places", "Orte"],
  doors: ["Doors", "Türen"],
  locations: ["Locations with codes", "Lagerplätze mit Codes"],
  lines: ["Lines", "Linien"],
  regions: ["Regions", "Regionen"],
  graph: ["Adjacency graph", "Nachbarschaftsgraph"],
  occupancy: ["Occupancy", "Belegung"],
  occupied: ["occupied", "belegt"],
  empty: ["empty", "leer"],
  unknown: ["unknown", "unbekannt"],
  cogent: ["cogent: obstruction", "zwingend: Hindernis"],
  storageAccess: ["storage access", "Lagerzugriff"],
  invalid: ["invalid: open", "ungültig: offen"],
  connected: ["connected", "verbunden"],
  disconnected: ["disconnected", "getrennt"],
  codeCurrent: ["code is sure", "Code ist sicher"],
  codeStale: ["code to be confirmed", "Code zu bestätigen"],
  staleMeaning: [
    "This place may be another one than the earlier scan knew by this code.",
    "Dieser Platz ist vielleicht ein anderer als der, den die frühere Aufnahme unter diesem Code kannte.",
  ],
  confirmCode: ["It is {code}", "Es ist {code}"],
} as const satisfies Texts;
