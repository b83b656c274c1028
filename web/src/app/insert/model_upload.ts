/** Upload of a model, which can be inserted afterwards. */

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
  /** Name of the model being sent; null: none. */
  readonly title = signal<string | null>(null);
  /** Bytes sent, and the total; null: not started. */
  readonly progress = signal<{ readonly sent: number; readonly total: number } | null>(null);
  readonly fault = signal("");
  /** Number of uploads; changes the addresses of the models' pictures. */
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

  /** Upload files; errors go to `fault`, which the dialog shows. */
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
