/** The corrections of a map: those that are saved, the draft over them, and the steps back and forth in it. */

import { readStored, writeStored } from "../stored";
import { getTagged, send, type Tagged } from "../service/request";
import type { Listed } from "./correction";
import {
  bodyOf,
  changeCount,
  emptyDraft,
  rebased,
  theirChanges,
  wantedList,
  type CorrectionDraft,
  type TheirChange,
  type Wanted,
} from "./draft";

interface CorrectionList {
  readonly version: number;
  readonly corrections: readonly Listed[];
}

export class Corrections {
  private draftNow: CorrectionDraft;
  /** Drafts before this one, and those that were undone. */
  private readonly past: CorrectionDraft[] = [];
  private future: CorrectionDraft[] = [];
  private readonly listeners = new Set<() => void>();

  private constructor(
    private readonly map: string,
    private read: Tagged<CorrectionList>,
  ) {
    this.draftNow = readStored<CorrectionDraft>(this.key) ?? emptyDraft(read.body.version);
  }

  static async of(map: string): Promise<Corrections> {
    return new Corrections(map, await getTagged<CorrectionList>(`v1/maps/${map}/corrections`));
  }

  get listed(): readonly Listed[] {
    return this.read.body.corrections;
  }

  get version(): number {
    return this.read.body.version;
  }

  get tag(): string {
    return this.read.tag;
  }

  get draft(): CorrectionDraft {
    return this.draftNow;
  }

  get count(): number {
    return changeCount(this.draftNow);
  }

  /** The list as it would be. */
  get wanted(): Wanted[] {
    return wantedList(this.listed, this.draftNow);
  }

  /** What is sent to save or preview it. */
  get body(): { readonly corrections: ReturnType<typeof bodyOf> } {
    return { corrections: bodyOf(this.wanted) };
  }

  private get key(): string {
    return `stillage.corrections.${this.map}`;
  }

  onChange(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => void this.listeners.delete(listener);
  }

  /** Keeps a draft, in the browser too: it outlives a closed page and a service that is gone. */
  change(draft: CorrectionDraft): void {
    this.past.push(this.draftNow);
    this.future = [];
    this.put(draft);
  }

  private put(draft: CorrectionDraft): void {
    this.draftNow = draft;
    writeStored(this.key, changeCount(draft) === 0 ? undefined : draft);
    for (const listener of this.listeners) listener();
  }

  private forget(): void {
    this.past.length = 0;
    this.future = [];
  }

  get canUndoDraft(): boolean {
    return this.past.length > 0;
  }

  get canRedoDraft(): boolean {
    return this.future.length > 0;
  }

  undoDraft(): void {
    const before = this.past.pop();
    if (!before) return;
    this.future.push(this.draftNow);
    this.put(before);
  }

  redoDraft(): void {
    const after = this.future.pop();
    if (!after) return;
    this.past.push(this.draftNow);
    this.put(after);
  }

  discard(): void {
    this.change(emptyDraft(this.version));
  }

  /** Saves the draft as one version, over exactly the version that was read: 412 where another one is in force. */
  async save(): Promise<void> {
    await send("PATCH", `v1/maps/${this.map}/semantics`, this.body, this.tag);
    this.forget();
    await this.readList();
    this.put(emptyDraft(this.version));
  }

  /** A step back or forth over the versions that are saved. */
  async step(by: "undo" | "redo"): Promise<void> {
    await send("POST", `v1/maps/${this.map}/semantics/${by}`, undefined, this.tag);
    await this.reread();
  }

  /** Reads the list that is in force now, and lays the draft over it; tells what somebody else did. */
  async reread(): Promise<TheirChange[]> {
    const before = this.listed;
    await this.readList();
    if (this.draftNow.version !== this.version) this.forget();
    this.put(rebased(this.draftNow, this.listed, this.version));
    return theirChanges(before, this.listed);
  }

  private async readList(): Promise<void> {
    this.read = await getTagged<CorrectionList>(`v1/maps/${this.map}/corrections`);
  }
}
