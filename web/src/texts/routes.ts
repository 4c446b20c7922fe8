/** Texts of the tool for routes: English, German. */

import type { Texts } from "./text";

export const routesTexts = {
  routes: ["Routes", "Routen"],
  routesMeaning: [
    "Click on the map where the route begins and where it ends, or write a code, or x,y in metres.",
    "Klicken Sie auf der Karte, wo die Route beginnt und wo sie endet, oder geben Sie einen Code oder x,y in Metern ein.",
  ],
  from: ["From", "Von"],
  to: ["To", "Nach"],
  here: ["here", "hier"],
  footprint: ["Vehicle", "Fahrzeug"],
  radius: ["Its middle keeps {metres} m from obstacles.", "Seine Mitte hält {metres} m Abstand von Hindernissen."],
  best: ["Best is", "Am besten ist"],
  shortest: ["the shortest way", "der kürzeste Weg"],
  clearance: ["far from obstacles", "weit von Hindernissen"],
  swap: ["Swap", "Tauschen"],
  startAgain: ["Start again", "Neu beginnen"],
  routeFigures: [
    "{length} m, {time} s, {clearance} m from obstacles",
    "{length} m, {time} s, {clearance} m von Hindernissen",
  ],
  graphReport: ["Report on the navigation graph", "Bericht über den Navigationsgraphen"],
  graphFigures: [
    "{nodes} nodes, {lanes} lanes, {parts} parts; a way joins {share} % of the pairs that were tried.",
    "{nodes} Knoten, {lanes} Fahrspuren, {parts} Teile; {share} % der geprüften Paare verbindet ein Weg.",
  ],
  unreachableLocations: ["Unreachable locations", "Unerreichbare Lagerplätze"],
  deadEnds: ["Dead ends", "Sackgassen"],
  deadEnd: ["{metres} m back, {count} locations", "{metres} m zurück, {count} Lagerplätze"],
  narrowPassages: ["Narrow passages", "Engstellen"],
  narrowPassage: ["{width} m wide over {metres} m", "{width} m breit auf {metres} m"],
  asPicture: ["As a picture", "Als Bild"],
} as const satisfies Texts;
