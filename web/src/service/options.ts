/** The options of an analysis, as the OpenAPI document describes them. */

import { get } from "./request";

/** What the form needs of a JSON schema. */
interface Schema {
  readonly $ref?: string;
  readonly type?: string | readonly string[];
  readonly description?: string;
  readonly default?: unknown;
  readonly minimum?: number;
  readonly maximum?: number;
  readonly enum?: readonly string[];
  readonly oneOf?: readonly Schema[];
  readonly properties?: Readonly<Record<string, Schema>>;
}

/** One option. */
export interface OptionField {
  /** Its steps from the top: group and name. */
  readonly path: readonly string[];
  readonly kind: "number" | "choice" | "switch" | "text";
  readonly meaning: string;
  /** Its default as JSON; empty where there is none. */
  readonly standard: string;
  readonly values: readonly string[];
  readonly minimum: number | undefined;
  readonly maximum: number | undefined;
}

/** The fields of the schema `AnalysisOptions`, in its order. */
export async function readOptionFields(): Promise<OptionField[]> {
  const document = await get<{ components: { schemas: Record<string, Schema> } }>("openapi.json");
  return optionFields(document.components.schemas);
}

export function optionFields(schemas: Readonly<Record<string, Schema>>): OptionField[] {
  const fieldsOf = (schema: Schema, path: readonly string[]): OptionField[] =>
    Object.entries(schema.properties ?? {}).flatMap(([name, property]) => {
      const target = resolved(property, schemas);
      const steps = [...path, name];
      return target.properties ? fieldsOf(target, steps) : [optionField(steps, property, target)];
    });
  return fieldsOf(schemas["AnalysisOptions"] ?? {}, []);
}

function resolved(schema: Schema, schemas: Readonly<Record<string, Schema>>): Schema {
  const reference = schema.$ref ?? schema.oneOf?.find((part) => part.$ref)?.$ref;
  return reference ? (schemas[reference.split("/").at(-1) ?? ""] ?? schema) : schema;
}

function optionField(path: readonly string[], property: Schema, target: Schema): OptionField {
  const types = [target.type ?? []].flat();
  const isNumber = types.includes("number") || types.includes("integer");
  return {
    path,
    kind: target.enum ? "choice" : types.includes("boolean") ? "switch" : isNumber ? "number" : "text",
    meaning: (property.description ?? target.description ?? "").replaceAll("`", ""),
    standard: property.default === undefined ? "" : written(property.default),
    values: target.enum ?? [],
    minimum: target.minimum,
    maximum: target.maximum,
  };
}

/** How a value is written in its field. */
export function written(value: unknown): string {
  return JSON.stringify(value).replace(/^"(.*)"$/, "$1");
}

/** What of whole options is to be said beside the defaults, by path. The members of a group that may be absent are all said. */
export function saidOptions(fields: readonly OptionField[], options: unknown): Map<string, unknown> {
  const said = new Map<string, unknown>();
  for (const { path, standard } of fields) {
    let value = options;
    for (const step of path) value = (value as Readonly<Record<string, unknown>> | null | undefined)?.[step];
    if (value === undefined || value === null) continue;
    if (path.length > 2 || written(value) !== standard) said.set(path.join("/"), value);
  }
  return said;
}

/** The options that a person chose, by path, as the document that the service reads. */
export function optionDocument(chosen: ReadonlyMap<string, unknown>): Record<string, unknown> | undefined {
  if (chosen.size === 0) return undefined;
  const document: Record<string, unknown> = {};
  for (const [path, value] of chosen) {
    const steps = path.split("/");
    const last = steps.pop() ?? "";
    let place = document;
    for (const step of steps) place = (place[step] ??= {}) as Record<string, unknown>;
    place[last] = value;
  }
  return document;
}
