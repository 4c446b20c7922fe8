/** The options of an analysis by their paths: English, German. The English meanings are those of the OpenAPI document. */

import type { Text, Texts } from "./text";

/** The groups of options. */
export const optionGroups = {
  "": ["General", "Allgemein"],
  grid: ["Grid", "Raster"],
  categorization: ["Categories of cells", "Kategorien der Zellen"],
  "categorization relaxation": ["Categories of cells: relaxation", "Kategorien der Zellen: Relaxation"],
  orientation: ["Directions", "Richtungen"],
  regions: ["Regions", "Regionen"],
  decomposition: ["Decomposition", "Zerlegung"],
  annotation: ["Labels", "Labels"],
  "annotation relaxation": ["Labels: relaxation", "Labels: Relaxation"],
  declutter: ["Clutter", "Störungen"],
} as const satisfies Texts;

export const optionTexts: Readonly<Record<string, { readonly name: Text; readonly meaning: Text }>> = {
  seed: { name: ["Seed", "Startwert"], meaning: ["Seed of every random choice.", "Startwert jeder zufälligen Wahl."] },
  "grid/occupiedThreshold": {
    name: ["Occupied from", "Belegt ab"],
    meaning: ["Replaces occupied_thresh.", "Ersetzt occupied_thresh."],
  },
  "grid/freeThreshold": {
    name: ["Free up to", "Frei bis"],
    meaning: ["Replaces free_thresh.", "Ersetzt free_thresh."],
  },
  "grid/semantics": {
    name: ["Reading of grey", "Lesart von Grau"],
    meaning: [
      "Where the file's own free_thresh takes the grey that map savers write for unknown cells, 205, for free: intended reads it as unknown and says so in the warnings, nav2 keeps the letter of the file.",
      "Wo das free_thresh der Datei das Grau, das Kartenspeicherer für unbekannte Zellen schreiben (205), für frei hält: intended liest es als unbekannt und sagt es in den Warnungen, nav2 hält sich an den Buchstaben der Datei.",
    ],
  },
  "categorization/profile": {
    name: ["Features", "Merkmale"],
    meaning: [
      "paper13: the thirteen features of the paper's Table I. halmstad2017: those of the author's code of 2017.",
      "paper13: die dreizehn Merkmale aus Tabelle I der Veröffentlichung. halmstad2017: die des Programms ihres Autors von 2017.",
    ],
  },
  "categorization/beams": { name: ["Beams", "Strahlen"], meaning: ["Beams per cell.", "Strahlen je Zelle."] },
  "categorization/maxRangeM": {
    name: ["Longest beam", "Längster Strahl"],
    meaning: ["Longest beam, metres; unlimited when absent.", "Längster Strahl in Metern; unbegrenzt, wenn leer."],
  },
  "categorization/unknownBlocks": {
    name: ["Unknown blocks", "Unbekanntes hält auf"],
    meaning: ["Whether unknown cells stop beams.", "Ob unbekannte Zellen Strahlen aufhalten."],
  },
  "categorization/stride": {
    name: ["Stride", "Schrittweite"],
    meaning: [
      "Every how many columns and rows a free cell is measured.",
      "Jede wievielte Spalte und Zeile einer freien Zelle gemessen wird.",
    ],
  },
  "categorization/gapM": {
    name: ["Gap", "Lücke"],
    meaning: [
      "Smallest difference of consecutive beams that counts as a gap, metres.",
      "Kleinster Unterschied aufeinanderfolgender Strahlen, der als Lücke zählt, in Metern.",
    ],
  },
  "categorization/k": {
    name: ["Categories", "Kategorien"],
    meaning: [
      "Number of categories, or auto: as many as the features tell apart reliably.",
      "Anzahl der Kategorien, oder auto: so viele, wie die Merkmale zuverlässig unterscheiden.",
    ],
  },
  "categorization/maxK": {
    name: ["Most categories", "Höchstens Kategorien"],
    meaning: ["Most categories when their number is found.", "Größte Anzahl der Kategorien, wenn sie gesucht wird."],
  },
  "categorization/scaling": {
    name: ["Scaling", "Skalierung"],
    meaning: ["How features are made comparable.", "Wie Merkmale vergleichbar gemacht werden."],
  },
  "categorization/clustering": {
    name: ["Clustering", "Gruppierung"],
    meaning: [
      "kMeans: the nearest of k centroids. gaussianMixture: the likeliest of k normal distributions.",
      "kMeans: der nächste von k Schwerpunkten. gaussianMixture: die wahrscheinlichste von k Normalverteilungen.",
    ],
  },
  "categorization/covariance": {
    name: ["Covariance", "Kovarianz"],
    meaning: [
      "Covariances of the components of a Gaussian mixture.",
      "Kovarianzen der Komponenten einer Gaußschen Mischverteilung.",
    ],
  },
  "categorization/restarts": {
    name: ["Restarts", "Neustarts"],
    meaning: ["Restarts of k-means.", "Neustarts von k-Means."],
  },
  "categorization/maxIterations": {
    name: ["Most iterations", "Höchstens Durchläufe"],
    meaning: [
      "Most iterations of one run of k-means or of expectation-maximization.",
      "Größte Anzahl der Durchläufe von k-Means oder der Erwartungsmaximierung.",
    ],
  },
  "categorization/relaxation/iterations": {
    name: ["Iterations", "Durchläufe"],
    meaning: [
      "Most iterations, 10 when absent; it ends earlier when nothing moves.",
      "Größte Anzahl der Durchläufe, 10 wenn leer; es endet früher, wenn sich nichts mehr ändert.",
    ],
  },
  "orientation/method": {
    name: ["Method", "Verfahren"],
    meaning: [
      "energy: maxima of the radiogram energy. paper: gradient histogram, mixture, wavelet peaks.",
      "energy: Maxima der Radiogramm-Energie. paper: Gradientenhistogramm, Mischverteilung, Wavelet-Spitzen.",
    ],
  },
  "orientation/gradientScaleM": {
    name: ["Gradient scale", "Gradientenmaßstab"],
    meaning: [
      "Standard deviation of the Gaussian derivative, metres.",
      "Standardabweichung der Gaußschen Ableitung in Metern.",
    ],
  },
  "orientation/bins": {
    name: ["Bins", "Klassen"],
    meaning: ["Bins of the histogram over half a turn.", "Klassen des Histogramms über eine halbe Drehung."],
  },
  "orientation/maxComponents": {
    name: ["Most components", "Höchstens Komponenten"],
    meaning: ["Most components of the mixture.", "Größte Anzahl der Komponenten der Mischverteilung."],
  },
  "orientation/minPeak": {
    name: ["Smallest peak", "Kleinste Spitze"],
    meaning: [
      "Smallest height of a peak above the floor, as a share of the highest.",
      "Kleinste Höhe einer Spitze über dem Grund, als Anteil der höchsten.",
    ],
  },
  "orientation/minSeparationDeg": {
    name: ["Smallest angle", "Kleinster Winkel"],
    meaning: [
      "Smallest angle between two orientations, degrees.",
      "Kleinster Winkel zwischen zwei Richtungen in Grad.",
    ],
  },
  "orientation/refine": {
    name: ["Refine", "Verfeinern"],
    meaning: [
      "Whether each orientation is refined to the nearby maximum of radiogram energy.",
      "Ob jede Richtung auf das nahe Maximum der Radiogramm-Energie verfeinert wird.",
    ],
  },
  "regions/method": {
    name: ["Method", "Verfahren"],
    meaning: [
      "energy: by the direction of structure. gabor: by texture. single: the whole map is one region.",
      "energy: nach der Richtung der Struktur. gabor: nach der Textur. single: die ganze Karte ist eine Region.",
    ],
  },
  "regions/count": {
    name: ["Regions", "Regionen"],
    meaning: [
      "Number of texture clusters; chosen automatically when absent.",
      "Anzahl der Texturgruppen; selbsttätig gewählt, wenn leer.",
    ],
  },
  "regions/maxCount": {
    name: ["Most regions", "Höchstens Regionen"],
    meaning: [
      "Most texture clusters when the number is chosen automatically.",
      "Größte Anzahl der Texturgruppen, wenn sie selbsttätig gewählt wird.",
    ],
  },
  "regions/wavelengthsM": {
    name: ["Wavelengths", "Wellenlängen"],
    meaning: [
      "Shortest and longest wavelength of the Gabor bank, metres.",
      "Kürzeste und längste Wellenlänge der Gabor-Filter in Metern.",
    ],
  },
  "regions/smoothingM": {
    name: ["Smoothing", "Glättung"],
    meaning: ["Smoothing of the texture energy, metres.", "Glättung der Texturenergie in Metern."],
  },
  "regions/tileM": {
    name: ["Tile", "Kachel"],
    meaning: [
      "Side of a tile, the grain of region boundaries, metres.",
      "Seite einer Kachel, die Körnung der Regionsgrenzen, in Metern.",
    ],
  },
  "regions/minShare": {
    name: ["Smallest share", "Kleinster Anteil"],
    meaning: ["Smallest region, as a share of the known area.", "Kleinste Region, als Anteil der bekannten Fläche."],
  },
  "decomposition/method": {
    name: ["Method", "Verfahren"],
    meaning: [
      "adaptive: aisles, rows, then cells by the evidence for their borders. paper: infinite lines.",
      "adaptive: Gänge, Reihen, dann Zellen nach den Hinweisen auf ihre Grenzen. paper: unendliche Linien.",
    ],
  },
  "decomposition/vehicleWidthM": {
    name: ["Vehicle width", "Fahrzeugbreite"],
    meaning: [
      "Width of the narrowest vehicle that drives in the aisles, metres, or auto: the one for which the site has aisles between its rows; the warnings say which.",
      "Breite des schmalsten Fahrzeugs, das in den Gängen fährt, in Metern, oder auto: die, für welche die Anlage Gänge zwischen ihren Reihen hat; die Warnungen sagen, welche.",
    ],
  },
  "decomposition/pitchM": {
    name: ["Place width", "Platzbreite"],
    meaning: [
      "Hint: narrowest and widest place along its aisle, metres.",
      "Hinweis: schmalster und breitester Platz entlang seines Ganges in Metern.",
    ],
  },
  "decomposition/depthM": {
    name: ["Place depth", "Platztiefe"],
    meaning: ["Hint: shallowest and deepest place, metres.", "Hinweis: flachster und tiefster Platz in Metern."],
  },
  "decomposition/smoothingM": {
    name: ["Smoothing", "Glättung"],
    meaning: [
      "Width of the Hann window over a radiogram, metres.",
      "Breite des Hann-Fensters über einem Radiogramm in Metern.",
    ],
  },
  "decomposition/minDistanceM": {
    name: ["Line distance", "Linienabstand"],
    meaning: [
      "Smallest distance between two parallel lines, metres.",
      "Kleinster Abstand zweier paralleler Linien in Metern.",
    ],
  },
  "decomposition/minPeak": {
    name: ["Smallest peak", "Kleinste Spitze"],
    meaning: [
      "Smallest peak, as a share of the highest of its radiogram.",
      "Kleinste Spitze, als Anteil der höchsten ihres Radiogramms.",
    ],
  },
  "annotation/method": {
    name: ["Method", "Verfahren"],
    meaning: [
      "faces: clusters of faces. vote: the category of most of its free cells.",
      "faces: Gruppen von Flächen. vote: die Kategorie der meisten ihrer freien Zellen.",
    ],
  },
  "annotation/categories": {
    name: ["Categories", "Kategorien"],
    meaning: ["Number of categories of faces (with faces).", "Anzahl der Kategorien von Flächen (bei faces)."],
  },
  "annotation/supportWidthM": {
    name: ["Support width", "Stützbreite"],
    meaning: [
      "Half width of the strip along an edge in which occupied cells support it, metres.",
      "Halbe Breite des Streifens entlang einer Kante, in dem belegte Zellen sie stützen, in Metern.",
    ],
  },
  "annotation/relaxation/iterations": {
    name: ["Iterations", "Durchläufe"],
    meaning: [
      "Most iterations, 10 when absent; it ends earlier when nothing moves.",
      "Größte Anzahl der Durchläufe, 10 wenn leer; es endet früher, wenn sich nichts mehr ändert.",
    ],
  },
  "declutter/method": {
    name: ["Method", "Verfahren"],
    meaning: [
      "adaptive: lone hits and small holes, by what is around them. none: the stages see the map as it is.",
      "adaptive: einzelne Treffer und kleine Löcher, nach dem, was um sie ist. none: die Stufen sehen die Karte, wie sie ist.",
    ],
  },
};
