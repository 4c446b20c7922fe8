/** The tools of a map, in the order of their tabs. */

import { analyses } from "./analyses/analyses";
import { compare } from "./compare/compare";
import { correct } from "./correct/correct";
import { decide } from "./decide/decide";
import { handOver } from "./hand_over/hand_over";
import { look } from "./look/look";
import { routes } from "./routes/routes";
import type { Tool } from "./workspace";

export const TOOLS: readonly Tool[] = [look, decide, correct, compare, analyses, routes, handOver];
