/** The GLB files of the simulated world: fetched when the manifest names them, dropped when it no longer does. */

import { signal } from "@preact/signals";
import type { Group } from "three";

import type { Manifest } from "../../protocol/generated/page_messages";
import { fetchBytes, GlbModel, SharedContents } from "./glb_model";
import type { WorldLighting } from "./world_lighting";

const AT_ONCE = 4;

interface Entry {
  readonly abort: AbortController;
  share: number;
  model: GlbModel | null;
}

export class WorldFiles {
  readonly progress = signal(1);
  readonly faults = signal<readonly string[]>([]);
  private readonly entries = new Map<string, Entry>();
  private waiting: { readonly id: string; readonly url: string; readonly entry: Entry }[] = [];
  private active = 0;
  private readonly contents = new SharedContents();

  /** `onChange`: a model came or went. */
  constructor(
    private readonly root: Group,
    private readonly lighting: WorldLighting,
    private readonly onChange: (added: GlbModel | null, removed: GlbModel | null) => void,
  ) {}

  /** Loaded models. */
  get models(): readonly GlbModel[] {
    return [...this.entries.values()].flatMap(({ model }) => model ?? []);
  }

  /** Show exactly these files; a file is identified by its id and address. */
  show(files: Manifest["files"]): void {
    const current = new Map(files.map((file) => [`${file.id} ${file.url}`, file]));
    for (const key of [...this.entries.keys()]) if (!current.has(key)) this.drop(key);
    if (this.entries.size === 0) {
      this.contents.dispose();
      this.faults.value = [];
    }
    for (const [key, { id, url }] of current) {
      if (this.entries.has(key)) continue;
      const entry: Entry = { abort: new AbortController(), share: 0, model: null };
      this.entries.set(key, entry);
      this.waiting.push({ id, url, entry });
    }
    this.count();
    this.fetchNext();
  }

  /** Read a file; `onShare` gets the ratio that has arrived. */
  async read(url: string, onShare: (share: number) => void, abort: AbortSignal): Promise<GlbModel> {
    const address = new URL(url, document.baseURI).href;
    const data = await fetchBytes(address, onShare, abort);
    return GlbModel.read(data, address.slice(0, address.lastIndexOf("/") + 1), this.lighting, this.contents);
  }

  private fetchNext(): void {
    while (this.active < AT_ONCE) {
      const next = this.waiting.shift();
      if (next === undefined) return;
      if (next.entry.abort.signal.aborted) continue;
      this.active += 1;
      void this.load(next).finally(() => {
        this.active -= 1;
        next.entry.share = 1;
        this.count();
        this.fetchNext();
      });
    }
  }

  private async load({ id, url, entry }: (typeof this.waiting)[number]): Promise<void> {
    const onShare = (share: number): void => {
      entry.share = 0.95 * share; // the rest counts for parsing the file
      this.count();
    };
    try {
      const model = await this.read(url, onShare, entry.abort.signal);
      if (entry.abort.signal.aborted) {
        model.dispose();
        return;
      }
      entry.model = model;
      this.root.add(model.root);
      this.onChange(model, null);
    } catch (error) {
      if (entry.abort.signal.aborted) return;
      this.fault(id, error);
    }
  }

  /** Report that something is not shown, and why. */
  fault(title: string, error: unknown): void {
    const reason = error instanceof Error ? error.message : String(error);
    this.faults.value = [...this.faults.peek(), `${title} is not shown: ${reason}`];
  }

  private drop(key: string): void {
    const entry = this.entries.get(key);
    this.entries.delete(key);
    entry?.abort.abort();
    if (entry?.model === undefined || entry.model === null) return;
    this.root.remove(entry.model.root);
    entry.model.dispose();
    this.onChange(null, entry.model);
  }

  private count(): void {
    let sum = 0;
    for (const { share } of this.entries.values()) sum += share;
    this.progress.value = this.entries.size === 0 ? 1 : sum / this.entries.size;
  }
}
