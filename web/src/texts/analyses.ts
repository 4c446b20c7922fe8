/** Texts of the tool that analyses a map again, and of what carries labels over: English, German. */

import type { Texts } from "./text";

export const analysesTexts = {
  analyses: ["Analyses", "Analysen"],
  analysesMeaning: [
    "A map can be analysed again with other options. The result is a proposal: nobody sees it before it is put in force, and the way back stays open.",
    "Eine Karte lässt sich mit anderen Optionen erneut analysieren. Das Ergebnis ist ein Entwurf: Niemand sieht es, bevor es in Kraft gesetzt wird, und der Weg zurück bleibt offen.",
  ],
  analysisOf: ["Analysis, {moment}", "Analyse, {moment}"],
  analysisInForceOf: ["In force, {moment}", "Gilt, {moment}"],
  isInForce: ["in force", "gilt"],
  isProposal: [
    "This is the result: a proposal, which nobody else sees yet.",
    "Das ist das Ergebnis: ein Entwurf, den noch niemand sonst sieht.",
  ],
  sameOptions: ["The options are the same.", "Die Optionen sind dieselben."],
  differentOptions: ["Options that differ from those in force:", "Optionen, die von den geltenden abweichen:"],
  compareWithInForce: ["Compare with what is in force", "Mit dem Geltenden vergleichen"],
  activate: ["Put in force", "In Kraft setzen"],
  activateQuestion: ["Put this analysis in force?", "Diese Analyse in Kraft setzen?"],
  activateMeaning: [
    "Everybody sees it then, with its corrections and codes.",
    "Dann sehen sie alle, mit ihren Berichtigungen und Codes.",
  ],
  activateKeeps: [
    "All labels that people gave are kept.",
    "Alle Labels, die Menschen vergeben haben, bleiben erhalten.",
  ],
  activateLoses: [
    "Labels that people gave and that find no ground there: {lost}. The comparison lists them. They are back when the analysis before is in force again.",
    "Labels von Menschen, die dort keinen Grund finden: {lost}. Der Vergleich führt sie auf. Sie sind wieder da, wenn die vorige Analyse wieder gilt.",
  ],
  analysisInForce: ["The other analysis is in force now.", "Die andere Analyse gilt jetzt."],
  analyseAgain: ["Analyse again", "Erneut analysieren"],
  againMeaning: [
    "The form begins with the options of the analysis in force; what you change makes another analysis.",
    "Das Formular beginnt mit den Optionen der geltenden Analyse; was Sie ändern, ergibt eine andere.",
  ],
  beginWith: ["Begin with the options of", "Beginnen mit den Optionen von"],
  allDefaults: ["none: all defaults", "keiner: alle Standardwerte"],
  wouldChange: ["If it was put in force:", "Wenn sie in Kraft gesetzt würde:"],
  facesOfProposal: [
    "Faces: {added} added, {removed} removed, {reshaped} with another shape, {relabelled} with another label.",
    "Flächen: {added} neu, {removed} entfallen, {reshaped} mit anderer Form, {relabelled} mit anderem Label.",
  ],
  wouldKeep: [
    "Labels that people gave: {kept} would be kept, {lost} lost.",
    "Labels von Menschen: {kept} blieben erhalten, {lost} gingen verloren.",
  ],
  labelsLost: ["Labels that would be lost", "Labels, die verloren gingen"],
  lostOfFace: ["Face {face}: {label}", "Fläche {face}: {label}"],
  lostOfCategory: ["Category {category}: {label}", "Kategorie {category}: {label}"],
} as const satisfies Texts;
