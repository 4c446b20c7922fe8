/** Every text of the page by its name. What the service says stays in its own words. */

import { analysesTexts } from "./analyses";
import { compareTexts } from "./compare";
import { correctTexts } from "./correct";
import { decideTexts } from "./decide";
import { everywhereTexts } from "./everywhere";
import { handOverTexts } from "./hand_over";
import { lookTexts } from "./look";
import { mapTexts } from "./map";
import { mapsTexts } from "./maps";
import { routesTexts } from "./routes";

/** The tables, one for each part of the page. A name stands in one of them. */
export const TABLES = [
  everywhereTexts,
  mapsTexts,
  mapTexts,
  lookTexts,
  decideTexts,
  correctTexts,
  compareTexts,
  analysesTexts,
  routesTexts,
  handOverTexts,
] as const;

export const texts = {
  ...everywhereTexts,
  ...mapsTexts,
  ...mapTexts,
  ...lookTexts,
  ...decideTexts,
  ...correctTexts,
  ...compareTexts,
  ...analysesTexts,
  ...routesTexts,
  ...handOverTexts,
};

export type TextName = keyof typeof texts;
