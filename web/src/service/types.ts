/** The documents of the service, by the names of its OpenAPI document. */

import type { components } from "./openapi";

type Schemas = components["schemas"];

export type MapView = Schemas["MapSummary"];
export type Job = Schemas["Job"];
export type Category = Schemas["Category"];
export type Semantics = Schemas["Semantics"];
export type RuleSet = Schemas["RuleSet"];
export type Label = Schemas["Label"];
export type Cogency = Schemas["Cogency"];
export type CogencyMatrix = Schemas["CogencyMatrix"];
export type CogencyRule = Schemas["CogencyRule"];
export type Functionality = Schemas["Functionality"];
export type Diagnostics = Schemas["Diagnostics"];
export type Frame = Schemas["Frame"];
export type Georeference = Schemas["Georeference"];
export type Route = Schemas["Route"];
export type GraphReport = Schemas["GraphReport"];
export type Export = Schemas["Export"];
export type Evaluation = Schemas["Evaluation"];
export type LabelScores = Schemas["LabelScores"];
export type LabelComparison = Schemas["LabelComparison"];
export type MapComparison = Schemas["MapComparison"];
export type LocationChanges = Schemas["LocationChanges"];
export type LabelPreview = Schemas["LabelPreview"];
export type Registry = Schemas["Registry"];
export type Analysis = Schemas["Analysis"];
export type AnalysisComparison = Schemas["AnalysisComparison"];
export type CarriedLabels = Schemas["CarriedLabels"];
export type DeletedMap = Schemas["DeletedMap"];
export type ListedCorrection = Schemas["ListedCorrection"];
