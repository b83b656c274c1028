/** Edits that can be undone, newest last. */

import { computed, signal, type ReadonlySignal } from "@preact/signals";

import type { DeferredUndo, PageUndo } from "../page/page";

interface Edit {
  readonly title: string;
  readonly redo: () => void;
  readonly undo: () => void;
}

const DEPTH = 200;

export class UndoHistory implements PageUndo {
  private readonly done = signal<readonly Edit[]>([]);
  private readonly undone = signal<readonly Edit[]>([]);
  private readonly others = signal<ReadonlySignal<DeferredUndo | null> | null>(null);
  private readonly other = computed(() => this.others.value?.value ?? null);
  /** Edits in progress, which are not recorded yet. */
  private readonly pending = new Set<Promise<unknown>>();
  readonly undoTitle = computed(() =>
    this.other.value === null ? (this.done.value.at(-1)?.title ?? null) : this.other.value.undoTitle,
  );
  readonly redoTitle = computed(() =>
    this.other.value === null ? (this.undone.value.at(-1)?.title ?? null) : this.other.value.redoTitle,
  );

  defer(other: ReadonlySignal<DeferredUndo | null>): void {
    this.others.value = other;
  }

  run(title: string, redo: () => void, undo: () => void): void {
    redo();
    this.record(title, redo, undo);
  }

  record(title: string, redo: () => void, undo: () => void): void {
    this.done.value = [...this.done.peek(), { title, redo, undo }].slice(-DEPTH);
    this.undone.value = [];
  }

  /** Record an edit once it is done; undo and redo wait until then. */
  ask<T>(edit: Promise<T>): Promise<T> {
    const pending = edit.finally(() => this.pending.delete(pending));
    this.pending.add(pending);
    return pending;
  }

  undo(): void {
    const other = this.other.peek();
    if (other !== null) {
      other.undo();
      return;
    }
    if (this.pending.size > 0) {
      this.afterPending(() => this.undo());
      return;
    }
    const edit = this.done.peek().at(-1);
    if (edit === undefined) return;
    edit.undo();
    this.done.value = this.done.peek().slice(0, -1);
    this.undone.value = [...this.undone.peek(), edit];
  }

  redo(): void {
    const other = this.other.peek();
    if (other !== null) {
      other.redo();
      return;
    }
    if (this.pending.size > 0) {
      this.afterPending(() => this.redo());
      return;
    }
    const edit = this.undone.peek().at(-1);
    if (edit === undefined) return;
    edit.redo();
    this.undone.value = this.undone.peek().slice(0, -1);
    this.done.value = [...this.done.peek(), edit];
  }

  private afterPending(next: () => void): void {
    void Promise.allSettled(this.pending).then(next);
  }
}
