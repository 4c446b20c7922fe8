/** What files for other programs are for, and their options: German. The English texts are those that the service sends. */

/** By the name of the file. */
export const germanPurposes: Readonly<Record<string, string>> = {
  "lif.json": "Layout Interchange Format 1.0: Graph und Stationen für Flottenmanager",
  "lif-2.0.json": "Layout Interchange Format 2.0 (Entwurf), mit dem freien Raum neben jeder Kante",
  "vda5050-zone-set.json": "Zonensatz nach VDA 5050 3.0: was Fahrzeuge wo dürfen",
  "nav2-route.geojson": "Routengraph von Nav2",
  "nav2-keepout.zip": "Maske eines Kostenkartenfilters von Nav2: wo Fahrzeuge nicht fahren dürfen",
  "nav2-speed.zip": "Maske eines Kostenkartenfilters von Nav2: wo Fahrzeuge langsam fahren müssen",
  "nav2-vector-objects.yaml": "Wo Fahrzeuge nicht fahren dürfen, als Polygone für den Vektorobjektserver von Nav2",
  "rmf-nav-graph.yaml": "Navigationsgraph für Flottenadapter von Open-RMF",
  "rmf.building.yaml": "Gebäudedatei für den Verkehrseditor von Open-RMF",
  "map.map": "Rasterkarte der MovingAI-Vergleichsaufgaben, für Planer mit vielen Fahrzeugen",
  "locations.csv": "Lagerplätze für Bestandssysteme",
  "locations.xlsx": "Lagerplätze als Tabelle",
  "graph.graphml": "Der Graph für Programme, die Graphen untersuchen",
  "faces.fgb": "Flächen mit ihren Eigenschaften als FlatGeobuf, für GIS",
  "map.gpkg": "Alle Sammlungen als GeoPackage, für GIS",
  "bundle.zip": "All dies mit Prüfsummen",
  "vda5050-download-map.json": "Sofortaktion nach VDA 5050 3.0, mit der ein Fahrzeug das Paket abholt",
};

/** By the name of the option. */
export const germanExportOptions: Readonly<Record<string, string>> = {
  footprintRadiusM:
    "Abstand der Fahrzeugmitte von Hindernissen in Metern, 0 bis 10; wenn leer, die halbe Fahrzeugbreite der Analyse",
  zones:
    "Zonen der Labels als LABEL:REGEL, durch Kommas getrennt; die Regel ist ein Zonentyp von VDA 5050 mit seinem Wert oder NONE. Wenn leer, entscheidet, wozu ein Label dient",
  manufacturer: "Hersteller des Fahrzeugs, an das die Nachricht geht; any, wenn leer",
  serialNumber: "Seriennummer dieses Fahrzeugs; any, wenn leer",
  workPlaces: "Ob Fahrzeuge an Arbeitsplätzen wie Büros fahren dürfen: open oder closed; closed, wenn leer",
  junctionPercent:
    "Höchste Geschwindigkeit auf Kreuzungen in Prozent der eigenen des Fahrzeugs, 1 bis 100; 50, wenn leer",
  workPlacePercent: "Höchste Geschwindigkeit an Arbeitsplätzen, ebenso; 25, wenn leer",
  profile: "Spalten der Tabelle: generic, odoo, sap-ewm oder business-central; generic, wenn leer",
  warehouse:
    "Name des Lagers im Bestandssystem: übergeordneter Lagerort, Lagernummer (4 Zeichen in SAP EWM) oder Lagerortcode (10 in Business Central); WH, wenn leer",
  storageType: "Lagertyp (4 Zeichen) in SAP EWM, Zonencode (10) in Business Central; BULK, wenn leer",
  crs: "Koordinatensystem: EPSG:3857 (bei einer Karte ohne Georeferenz die Meter ihres Rahmens) oder CRS84 (Länge, Breite); EPSG:3857, wenn leer",
  link: "Wo Fahrzeuge bundle.zip abholen; beim Dienst selbst, wenn leer",
};
