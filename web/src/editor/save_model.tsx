/** Saving the model that is edited: model.sdf and model.config in a folder below that where Trundle was started. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";

import { Dialog } from "../app/dialogs/dialog";
import type { Shell } from "../app/shell";
import { sentence } from "../panels/use";

export function SaveModel({ shell }: { readonly shell: Shell }): JSX.Element {
  const offered = shell.editor.draft.value?.folder ?? null;
  const folder = useSignal(offered ?? "");
  const exists = useSignal<string | null>(null);
  const fault = useSignal("");
  const isBusy = useSignal(false);
  const close = (): void => {
    shell.dialog.value = null;
  };
  const save = async (): Promise<void> => {
    const name = folder.peek().trim();
    isBusy.value = true;
    try {
      const answer = await shell.page.connection.request("draft_save", { folder: name, replace: exists.peek() === name });
      exists.value = answer.exists ?? null;
      fault.value = "";
      if (answer.exists !== undefined) return;
      shell.notices.report("Model", `saved in ${answer.folder ?? name}`, "ok");
      close();
    } catch (error) {
      fault.value = sentence(error);
    } finally {
      isBusy.value = false;
    }
  };
  return (
    <Dialog title="Save the model" class="ask" onClose={close}>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          void save();
        }}
      >
        {offered === null ? (
          <p>The folder where Trundle was started cannot be written.</p>
        ) : (
          <label>
            Folder, below the one where Trundle was started
            <span class={`field${fault.value === "" ? "" : " wrong"}`}>
              <input
                aria-label="Folder"
                value={folder.value}
                spellcheck={false}
                autocomplete="off"
                autoFocus
                onInput={(event) => {
                  folder.value = event.currentTarget.value;
                  exists.value = null;
                }}
              />
            </span>
          </label>
        )}
        {fault.value !== "" && <p class="fault" role="alert">{fault.value}</p>}
        {exists.value !== null && <p class="fault" role="alert">There is a model in {exists.value} already. Replace it?</p>}
        <p class="sm t2">It gets model.sdf and model.config.</p>
        <div class="foot">
          <span class="sp" />
          <button type="submit" class="b pri" disabled={isBusy.value || offered === null || folder.value.trim() === ""}>
            {exists.value === null ? "Save" : "Replace"}
          </button>
        </div>
      </form>
    </Dialog>
  );
}
