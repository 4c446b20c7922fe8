/** The labels of a map: what is in force, the draft over it, and what follows for each face and edge. */

import type { FeatureLike } from "ol/Feature";

import { rowOf } from "../map/geojson";
import type { COLORS } from "../map/look";
import type { Reading } from "../map/layers";
import { getTagged, get, Refused, send, type Tagged } from "../service/request";
import type { CogencyMatrix, Label, RuleSet, Semantics } from "../service/types";
import { readStored, writeStored } from "../stored";
import { differences, emptyDraft, isEmpty, labelUnder, patchOf, type Draft } from "./draft";
import { cogencyOf, editable } from "./rule_set_draft";

/** A colour for what has no label. */
const NONE = "#bdbdbd";

export class Labels implements Reading {
  private draftNow: Draft;
  /** Labels by face as the service says that the draft would give them. */
  private previewed: ReadonlyMap<number, string> | undefined;
  private readonly listeners = new Set<() => void>();

  private constructor(
    private readonly map: string,
    private read: Tagged<Semantics>,
    private rulesInForce: RuleSet,
    private matrix: CogencyMatrix,
    /** The row of a face. */
    private readonly faceRow: (id: number) => Readonly<Record<string, unknown>> | undefined,
  ) {
    this.draftNow = { ...emptyDraft(read.body.version), ...readStored<Draft>(this.key) };
  }

  static async of(
    map: string,
    faceRow: (id: number) => Readonly<Record<string, unknown>> | undefined,
  ): Promise<Labels> {
    const read = await getTagged<Semantics>(`v1/maps/${map}/semantics`);
    const [ruleSet, matrix] = await rulesOf(read.body.ruleSet);
    return new Labels(map, read, ruleSet, matrix, faceRow);
  }

  get inForce(): Semantics {
    return this.read.body;
  }

  /** Whether a person decided something here that can be taken back: not what was suggested or carried over. */
  get canUndo(): boolean {
    return this.inForce.version > 0 && this.inForce.origin !== "carried";
  }

  /** Whether the version in force restores another one: only then something comes after it. */
  get canRedo(): boolean {
    return "restores" in this.inForce;
  }

  /** The rule set whose labels are shown: the drafted one, else that in force. */
  get ruleSet(): Pick<RuleSet, "id" | "labels"> {
    const { rules } = this.draftNow;
    return rules ? { id: rules.document.id, labels: [...rules.document.labels] } : this.rulesInForce;
  }

  get draft(): Draft {
    return this.draftNow;
  }

  /** Keeps a draft, in the browser too: it outlives a closed page and a service that is gone. */
  set draft(draft: Draft) {
    this.draftNow = draft;
    this.previewed = undefined;
    writeStored(this.key, isEmpty(draft) ? undefined : draft);
    this.tell();
  }

  private get key(): string {
    return `stillage.draft.${this.map}`;
  }

  onChange(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => void this.listeners.delete(listener);
  }

  private tell(): void {
    for (const listener of this.listeners) listener();
  }

  discard(): void {
    this.draft = emptyDraft(this.inForce.version);
  }

  /** What the service says of the draft: the faces whose labels it would change. It holds until the draft changes. */
  showPreview(changed: ReadonlyMap<number, string>): void {
    this.previewed = changed;
    this.tell();
  }

  /** Saves the draft as a new version, over exactly the version that was read: 412 where another one is in force. */
  async save(): Promise<void> {
    await this.storeRules();
    const patch = patchOf(this.draftNow);
    if (Object.keys(patch).length === 0) return this.reread();
    const saved = await send<Semantics>("PATCH", `v1/maps/${this.map}/semantics`, patch, this.read.tag);
    await this.accept(saved);
    this.discard();
  }

  /** Stores the drafted rule set, so that labels can name it. */
  private async storeRules(): Promise<void> {
    const { rules, ...others } = this.draftNow;
    if (!rules || rules.isStored) return;
    const { document, replaces } = rules;
    const path = `v1/rule-sets/${encodeURIComponent(document.id)}`;
    try {
      if (replaces === undefined) await send("POST", "v1/rule-sets", document);
      else await send("PUT", path, document, replaces);
    } catch (error) {
      // Somebody else changed the rule set: what is drafted lies over theirs from now on.
      if (error instanceof Refused && error.status === 412) {
        const { tag } = await getTagged<RuleSet>(path);
        this.draft = { ...others, rules: { document, isStored: false, replaces: tag } };
      }
      throw error;
    }
    const isInForce = document.id === this.inForce.ruleSet;
    this.draft = isInForce ? others : { ...others, rules: { document, isStored: true } };
  }

  /** Reads what is in force now; the draft stays. */
  async reread(): Promise<void> {
    const before = this.inForce;
    const read = await getTagged<Semantics>(`v1/maps/${this.map}/semantics`);
    await this.accept(read);
    // A version that changed no label (its corrections, for example) is no conflict with the draft.
    const isSame = this.draftNow.version === before.version && differences(before, this.inForce).length === 0;
    if (isSame) this.draftNow = { ...this.draftNow, version: this.inForce.version };
    this.tell();
  }

  /** Puts an earlier version in force, as a new one. */
  restore(version: number): Promise<void> {
    return this.post(`versions/${version}/restore`);
  }

  /** One step back or forth over the versions; the service refuses where there is none. */
  step(by: "undo" | "redo"): Promise<void> {
    return this.post(by);
  }

  private async post(path: string): Promise<void> {
    const saved = await send<Semantics>("POST", `v1/maps/${this.map}/semantics/${path}`, undefined, this.read.tag);
    await this.accept(saved);
    this.tell();
  }

  private async accept(read: Tagged<Semantics>): Promise<void> {
    this.read = read;
    [this.rulesInForce, this.matrix] = await rulesOf(read.body.ruleSet);
  }

  label(id: string): Label | undefined {
    return this.ruleSet.labels.find((label) => label.id === id);
  }

  color(id: string): string {
    return this.label(id)?.color ?? NONE;
  }

  labelOf(row: Readonly<Record<string, unknown>>): string {
    const previewed = this.previewed?.get(Number(row["id"]));
    if (previewed !== undefined) return previewed;
    const face = { id: Number(row["id"]), category: Number(row["category"]) };
    return labelUnder(this.draftNow, this.inForce, face, String(row["label"]));
  }

  colorOf(feature: FeatureLike): string {
    const row = rowOf(feature);
    return this.color("category" in row ? this.labelOf(row) : String(row["label"]));
  }

  cogencyOf(feature: FeatureLike): keyof typeof COLORS {
    const row = rowOf(feature);
    const read = String(row["cogency"]) as keyof typeof COLORS;
    if (isEmpty(this.draftNow)) return read;
    const sides = [row["faceLeft"], row["faceRight"]].map((id) =>
      typeof id === "number" ? this.faceRow(id) : undefined,
    );
    const [left, right] = sides.map((side) => side && this.labelOf(side));
    if (!left || !right) return read;
    const { rules } = this.draftNow;
    const isChanged = sides.some((side) => side && this.labelOf(side) !== side["label"]);
    if (!isChanged && !rules) return read;
    const document = rules?.document ?? { ...this.rulesInForce, cogency: this.rulesInForce.cogency ?? [] };
    return cogencyOf(editable(document), this.matrix, left, right) ?? read;
  }
}

async function rulesOf(id: string): Promise<[RuleSet, CogencyMatrix]> {
  const path = `v1/rule-sets/${encodeURIComponent(id)}`;
  return Promise.all([get<RuleSet>(path), get<CogencyMatrix>(`${path}/matrix`)]);
}
