/** Puts models, shapes and lights into the running world; undo takes them out, redo puts them back. */

import { effect, signal, type ReadonlySignal } from "@preact/signals";
import type { Vector3 } from "three";

import type { Answer } from "../../protocol/connection";
import type { ModelEntry } from "../../protocol/generated/page_messages";
import type { Insertable } from "../../page/insertable";
import type { Page, Selection } from "../../page/page";
import { ModelUpload, type UploadContext } from "./model_upload";
import { findModel } from "../../page/selection_lookup";

/** Question whether a model may run its code. */
export interface CodeConsent {
  readonly title: string;
  readonly files: readonly string[];
  readonly agree: () => void;
}

/** Parts of the page that insertions use. */
export interface InsertionContext extends UploadContext {
  readonly page: Page;
  /** False: there is no 3D view to click in. */
  readonly isDrawn: ReadonlySignal<boolean>;
}

export class Insertion {
  /** Models; null before the server has answered. */
  readonly models = signal<readonly ModelEntry[] | null>(null);
  readonly consentRequest = signal<CodeConsent | null>(null);
  readonly upload: ModelUpload;
  /** Item whose position a person types, in a page without a 3D view; null: none. */
  readonly typed = signal<Insertable | null>(null);

  constructor(private readonly context: InsertionContext) {
    const { page, layout } = context;
    this.upload = new ModelUpload(context, () => this.list());
    const { insert, current } = page.tools;
    if (insert === null) return;
    insert.onPlace = (item, point) => this.place(item, point);
    effect(() => {
      if (current.value === insert && insert.chosen.value === null) layout.open("insert");
    });
  }

  /** Ask for the models that can be inserted, which may have changed. */
  list(): void {
    this.context.page.connection.request("models", {}).then(
      ({ models }) => (this.models.value = models),
      (error: unknown) => this.report("Models", error),
    );
  }

  /** Choose the item that follows the pointer, or whose position is typed. */
  choose(item: Insertable): void {
    const { layout, page, isDrawn } = this.context;
    if (!isDrawn.peek()) {
      this.typed.value = item;
      return;
    }
    page.tools.insert?.choose(item);
    page.tools.use("trundle/Insert");
    if (layout.isPhone.peek()) layout.sheetHeight.value = "closed";
  }

  /** Insert an item at a point of the world [m]. */
  place(item: Insertable, point: Vector3, consent: string | null = null): void {
    void this.context.page.undo.ask(this.insert(item, point, consent));
  }

  private async insert(item: Insertable, point: Vector3, consent: string | null): Promise<void> {
    const position = point.toArray();
    const { connection } = this.context.page;
    try {
      const answer: Answer<"insert" | "insert_light"> =
        item.kind === "light"
          ? await connection.request("insert_light", { type: item.name, position })
          : await connection.request("insert", {
              model: item.name,
              position,
              is_shape: item.kind === "shape",
              consent,
            });
      if ("name" in answer) this.record(item, answer.name);
      else {
        const { code, consent } = answer;
        this.consentRequest.value = { title: item.title, files: code, agree: () => this.place(item, point, consent) };
      }
    } catch (error) {
      this.report(`Insert ${item.title}`, error);
    }
  }

  private record(item: Insertable, name: string): void {
    const isLight = item.kind === "light";
    const title = `Insert ${name}`;
    const { connection, undo } = this.context.page;
    const send = (request: "restore" | "delete") => (): void => {
      const result = isLight
        ? connection.request(`${request}_light`, { light: name })
        : connection.request(request, { model: name });
      result.catch((error: unknown) => this.report(title, error));
    };
    undo.record(title, send("restore"), send("delete"));
    selectOnceAdded(this.context.page, isLight ? { kind: "light", light: name } : { kind: "model", model: name });
  }

  private report(title: string, error: unknown): void {
    this.context.notices.report(title, error instanceof Error ? error.message : String(error));
  }
}

/** Select a model or a light once the manifest has it. */
export function selectOnceAdded(page: Page, selection: Extract<Selection, { kind: "model" | "light" }>): void {
  const stop = effect(() => {
    const lights = page.world.manifest.value?.lights ?? [];
    const isAdded =
      selection.kind === "model"
        ? findModel(page, selection.model) !== null
        : lights.some(({ name }) => name === selection.light);
    if (!isAdded) return;
    page.selection.value = selection;
    queueMicrotask(() => stop());
  });
}
