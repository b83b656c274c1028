/** Edits that can be taken back. */

import type { ReadonlySignal } from "@preact/signals";

export interface UndoStack {
  readonly undoTitle: ReadonlySignal<string | null>;
  readonly redoTitle: ReadonlySignal<string | null>;
  /** Do something now and remember how to undo it; "Change of Alpha". */
  run(title: string, redo: () => void, undo: () => void): void;
  /** Remember how to do again and undo what has been done. */
  record(title: string, redo: () => void, undo: () => void): void;
  undo(): void;
  redo(): void;
}
