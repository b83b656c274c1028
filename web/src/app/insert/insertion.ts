/** Puts models, shapes and lights into the running world; undo takes them out, redo puts them back. */

import { effect, signal } from "@preact/signals";
import type { Vector3 } from "three";

import type { Answer } from "../../protocol/connection";
import type { ModelEntry } from "../../protocol/generated/page_messages";
import type { Insertable } from "../../page/insertable";
import type { Command, Selection } from "../../page/page";
import type { Shell } from "../shell";
import { ModelUpload } from "./model_upload";
import { canEdit } from "../world/edits";
import { findModel } from "../../page/selection_lookup";

/** Code that a model would run, of which a person is asked. */
export interface AskedCode {
  readonly title: string;
  readonly files: readonly string[];
  readonly agree: () => void;
}

export class Insertion {
  /** Null before the server has answered. */
  readonly models = signal<readonly ModelEntry[] | null>(null);
  readonly asked = signal<AskedCode | null>(null);
  readonly upload: ModelUpload;

  constructor(private readonly shell: Shell) {
    this.upload = new ModelUpload(shell);
    const { insert, current } = shell.page.tools;
    if (insert === null) return;
    insert.onPlace = (thing, point) => this.place(thing, point);
    effect(() => {
      if (current.value === insert && insert.chosen.value === null) shell.layout.open("insert");
    });
  }

  /** Ask for the models that can be inserted, which may have changed. */
  list(): void {
    this.shell.page.connection.request("models", {}).then(
      ({ models }) => (this.models.value = models),
      (error: unknown) => this.report("Models", error),
    );
  }

  /** Have something follow the pointer. */
  choose(thing: Insertable): void {
    const { layout, page } = this.shell;
    page.tools.insert?.choose(thing);
    page.tools.use("trundle/Insert");
    if (layout.isPhone.peek()) layout.sheetHeight.value = "closed";
  }

  private place(thing: Insertable, point: Vector3, consent: string | null = null): void {
    void this.shell.page.undo.ask(this.insert(thing, point, consent));
  }

  private async insert(thing: Insertable, point: Vector3, consent: string | null): Promise<void> {
    const position = point.toArray();
    const { connection } = this.shell.page;
    try {
      const answer: Answer<"insert" | "insert_light"> =
        thing.kind === "light"
          ? await connection.request("insert_light", { type: thing.name, position })
          : await connection.request("insert", {
              model: thing.name,
              position,
              is_shape: thing.kind === "shape",
              consent,
            });
      if ("name" in answer) this.record(thing, answer.name);
      else {
        const { code, consent } = answer;
        this.asked.value = { title: thing.title, files: code, agree: () => this.place(thing, point, consent) };
      }
    } catch (error) {
      this.report(`Insert ${thing.title}`, error);
    }
  }

  private record(thing: Insertable, name: string): void {
    const isLight = thing.kind === "light";
    const title = `Insert ${name}`;
    const ask = (request: "restore" | "delete") => (): void =>
      isLight
        ? this.shell.request(title, `${request}_light`, { light: name })
        : this.shell.request(title, request, { model: name });
    this.shell.page.undo.record(title, ask("restore"), ask("delete"));
    selectOnceThere(this.shell, isLight ? { kind: "light", light: name } : { kind: "model", model: name });
  }

  private report(title: string, error: unknown): void {
    this.shell.notices.report(title, error instanceof Error ? error.message : String(error));
  }
}

/** Select a model or a light once the page knows of it. */
export function selectOnceThere({ page }: Shell, selection: Extract<Selection, { kind: "model" | "light" }>): void {
  const stop = effect(() => {
    const lights = page.world.manifest.value?.lights ?? [];
    const isThere =
      selection.kind === "model"
        ? findModel(page, selection.model) !== null
        : lights.some(({ name }) => name === selection.light);
    if (!isThere) return;
    page.selection.value = selection;
    queueMicrotask(() => stop());
  });
}

/** Keys while something follows the pointer. */
export function insertionCommands(shell: Shell): readonly Command[] {
  const { insert } = shell.page.tools;
  if (insert === null || !canEdit(shell)) return [];
  const command = (id: string, title: string, keys: string, run: () => void): Command => ({
    id,
    title,
    group: "Tools",
    keys,
    enabled: () => insert.chosen.peek() !== null,
    run,
  });
  return [
    { id: "upload_model", title: "Upload a model", group: "Simulation", run: () => shell.insertion.upload.open() },
    command("insert.place", "Put what is being inserted into the middle of the view", "Enter", () =>
      insert.placeInMiddle(),
    ),
    command("insert.leave", "Insert nothing", "Escape", () => shell.page.tools.use("rviz/Interact")),
  ];
}
