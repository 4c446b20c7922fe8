/** Texts of what several pages say: English, German. */

import type { Texts } from "./text";

export const everywhereTexts = {
  skip: ["Skip to the content", "Zum Inhalt springen"],
  language: ["Language", "Sprache"],
  reference: ["API reference", "API-Referenz"],
  maps: ["Maps", "Karten"],
  signInTitle: ["This service needs a key", "Dieser Dienst braucht einen Schlüssel"],
  signIn: ["Sign in", "Anmelden"],
  signOut: ["Sign out", "Abmelden"],
  key: ["Key or token", "Schlüssel oder Token"],
  keyMeaning: [
    "A key begins with stillage_ and comes from whoever runs the service; a token (JWT) comes from your sign-in elsewhere. You stay signed in for twelve hours, until the token ends, or until you sign out.",
    "Ein Schlüssel beginnt mit stillage_ und kommt von denen, die den Dienst betreiben; ein Token (JWT) kommt von Ihrer Anmeldung anderswo. Sie bleiben zwölf Stunden angemeldet, bis das Token endet, oder bis Sie sich abmelden.",
  ],
  cancel: ["Cancel", "Abbrechen"],
  keep: ["Keep", "Behalten"],
  delete: ["Delete", "Löschen"],
  remove: ["Remove {name}", "{name} entfernen"],
  progress: ["Progress", "Fortschritt"],
  unreachable: ["The service does not answer", "Der Dienst antwortet nicht"],
  unreachableMeaning: [
    "Nothing is lost: what you entered stays here. Check that the service runs and try again.",
    "Nichts ist verloren: Ihre Eingaben bleiben hier. Prüfen Sie, ob der Dienst läuft, und versuchen Sie es erneut.",
  ],
  aboutProblem: ["About this kind of problem", "Über diese Art von Problem"],
  licenses: ["Licences of the packages in this page", "Lizenzen der Pakete in dieser Seite"],
  connecting: [
    "The service does not answer. It is asked again until it does; nothing is lost.",
    "Der Dienst antwortet nicht. Er wird weiter gefragt, bis er antwortet; nichts geht verloren.",
  ],
} as const satisfies Texts;
