/** Undoable edits of an .rviz file; counts those since it was saved. */

import { computed, signal } from "@preact/signals";

import type { UndoStack } from "./undo_stack";

export class Edits {
  private readonly applied = signal<readonly number[]>([]);
  private readonly saved = signal<readonly number[]>([]);
  private next = 0;
  /** Number of edits between the current state and the saved one. */
  readonly count = computed(() => {
    const [now, then] = [this.applied.value, this.saved.value];
    const same = now.findIndex((edit, index) => edit !== then[index]);
    return now.length + then.length - 2 * (same < 0 ? now.length : same);
  });

  constructor(private readonly history: Pick<UndoStack, "run">) {}

  run(title: string, redo: () => void, undo: () => void): void {
    const edit = this.next;
    this.next += 1;
    this.history.run(
      title,
      () => {
        redo();
        this.applied.value = [...this.applied.peek(), edit];
      },
      () => {
        undo();
        this.applied.value = this.applied.peek().filter((other) => other !== edit);
      },
    );
  }

  /** Note that the current state was saved. */
  markSaved(): void {
    this.saved.value = this.applied.peek();
  }
}
