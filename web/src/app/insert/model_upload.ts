/** The upload of a model, after which it is among those to insert. */

import { signal, type Signal } from "@preact/signals";

import { sentence } from "../../panels/use";
import type { Layout } from "../layout";
import type { OpenDialog } from "../dialogs/open_dialog";
import type { Notices } from "../notices/notices";
import { sendModel, titleOf, type ModelFile } from "./model_files";

/** Parts of the page that an upload uses. */
export interface UploadContext {
  readonly layout: Layout;
  readonly notices: Notices;
  readonly dialog: Signal<OpenDialog>;
}

export class ModelUpload {
  /** What is being sent; null: nothing is. */
  readonly title = signal<string | null>(null);
  /** Bytes that are sent, and those of all; null: none is yet. */
  readonly progress = signal<{ readonly sent: number; readonly total: number } | null>(null);
  readonly fault = signal("");
  /** Uploads so far; pictures of those before are old. */
  readonly count = signal(0);

  private aborter = new AbortController();

  constructor(
    private readonly context: UploadContext,
    private readonly listModels: () => void,
  ) {}

  open(): void {
    this.fault.value = "";
    this.context.dialog.value = "upload";
  }

  cancel(): void {
    this.aborter.abort();
  }

  /** Upload files; what is wrong is said by the dialog. */
  async send(chosen: Promise<readonly ModelFile[]> | readonly ModelFile[]): Promise<void> {
    if (this.title.peek() !== null) return;
    this.fault.value = "";
    this.title.value = "";
    this.aborter = new AbortController();
    const { signal } = this.aborter;
    try {
      const files = await chosen;
      signal.throwIfAborted(); // folders that are dropped take a while to be read
      this.title.value = titleOf(files);
      this.end(await sendModel(files, signal, (sent, total) => (this.progress.value = { sent, total })));
    } catch (error) {
      if (signal.aborted) return;
      const title = this.title.peek() ?? "";
      this.fault.value = title === "" ? sentence(error) : `${title}: ${sentence(error)}`;
    } finally {
      this.title.value = null;
      this.progress.value = null;
    }
  }

  private end(names: readonly string[]): void {
    const { dialog, layout, notices } = this.context;
    this.count.value += 1;
    dialog.value = null;
    notices.report("Models", `${names.join(", ")} can be inserted`, "ok");
    layout.open("insert");
    this.listModels();
  }
}
