/** Edits that can be taken back, newest last. */

import { computed, signal } from "@preact/signals";

import type { UndoStack } from "./page";

interface Edit {
  readonly title: string;
  readonly redo: () => void;
  readonly undo: () => void;
}

const DEPTH = 200;

export class UndoHistory implements UndoStack {
  private readonly done = signal<readonly Edit[]>([]);
  private readonly undone = signal<readonly Edit[]>([]);
  readonly undoTitle = computed(() => this.done.value.at(-1)?.title ?? null);
  readonly redoTitle = computed(() => this.undone.value.at(-1)?.title ?? null);

  run(title: string, redo: () => void, undo: () => void): void {
    redo();
    this.record(title, redo, undo);
  }

  record(title: string, redo: () => void, undo: () => void): void {
    this.done.value = [...this.done.peek(), { title, redo, undo }].slice(-DEPTH);
    this.undone.value = [];
  }

  undo(): void {
    const edit = this.done.peek().at(-1);
    if (edit === undefined) return;
    edit.undo();
    this.done.value = this.done.peek().slice(0, -1);
    this.undone.value = [...this.undone.peek(), edit];
  }

  redo(): void {
    const edit = this.undone.peek().at(-1);
    if (edit === undefined) return;
    edit.redo();
    this.undone.value = this.undone.peek().slice(0, -1);
    this.done.value = [...this.done.peek(), edit];
  }
}
