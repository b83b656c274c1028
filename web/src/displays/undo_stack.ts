/** Edits that can be undone. */

import type { ReadonlySignal } from "@preact/signals";

export interface UndoStack {
  readonly undoTitle: ReadonlySignal<string | null>;
  readonly redoTitle: ReadonlySignal<string | null>;
  /** Run an edit and record how to undo it; title such as "Change of Alpha". */
  run(title: string, redo: () => void, undo: () => void): void;
  /** Record how to redo and undo an edit that is done. */
  record(title: string, redo: () => void, undo: () => void): void;
  undo(): void;
  redo(): void;
}
