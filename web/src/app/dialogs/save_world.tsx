/** Saving the world as SDF, with what was changed while it ran. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";

import { saveFile, sentence } from "../../panels/use";
import { Button } from "../../theme/button";
import { Dialog } from "./dialog";
import type { Command } from "../page";
import type { Shell } from "../shell";
import { canEdit } from "../world/edits";

export function saveCommands(shell: Shell): readonly Command[] {
  if (!canEdit(shell)) return [];
  const open = (): void => {
    shell.dialog.value = "save_world";
  };
  return [{ id: "save_world", title: "Save the world as SDF", group: "Simulation", keys: "Ctrl S", run: open }];
}

/** Asks for the file's name, and before another file is replaced. */
export function SaveWorld({ shell }: { readonly shell: Shell }): JSX.Element {
  const offered = shell.page.world.manifest.value?.file ?? null;
  const file = useSignal(offered ?? "");
  const exists = useSignal<string | null>(null);
  const fault = useSignal("");
  const isBusy = useSignal(false);
  const close = (): void => {
    shell.dialog.value = null;
  };
  const ask = async (name: string | null): Promise<void> => {
    isBusy.value = true;
    try {
      const replace = name !== null && exists.peek() === name;
      const answer = await shell.page.connection.request("save_world", { file: name, replace });
      exists.value = answer.exists ?? null;
      fault.value = "";
      if (answer.exists !== undefined) return;
      if (answer.sdf !== undefined) saveFile(downloadName(shell), new Blob([answer.sdf], { type: "application/xml" }));
      report(shell, answer.file, answer.lost ?? []);
      close();
    } catch (error) {
      fault.value = sentence(error);
    } finally {
      isBusy.value = false;
    }
  };
  return (
    <Dialog title="Save the world as SDF" class="ask" onClose={close}>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          void ask(offered === null ? null : file.peek().trim());
        }}
      >
        {offered === null ? (
          <p>The folder where Trundle was started cannot be written. The world can be downloaded.</p>
        ) : (
          <label>
            File, below the folder where Trundle was started
            <span class={`field${fault.value === "" ? "" : " wrong"}`}>
              <input
                aria-label="File"
                value={file.value}
                spellcheck={false}
                autocomplete="off"
                autoFocus
                onInput={(event) => {
                  file.value = event.currentTarget.value;
                  exists.value = null;
                }}
              />
            </span>
          </label>
        )}
        {fault.value !== "" && <p class="fault" role="alert">{fault.value}</p>}
        {exists.value !== null && <p class="fault" role="alert">{exists.value} is there already. Replace it?</p>}
        <p class="sm t2">What was changed is saved, where everything stands now. It starts at rest, at time 0.</p>
        <div class="foot">
          <Button icon="download" tone={offered === null ? "primary" : "line"} disabled={isBusy.value} onClick={() => void ask(null)}>
            Download
          </Button>
          <span class="sp" />
          {offered !== null && (
            <button type="submit" class="b pri" disabled={isBusy.value || file.value.trim() === ""}>
              {exists.value === null ? "Save" : "Replace"}
            </button>
          )}
        </div>
      </form>
    </Dialog>
  );
}

function downloadName({ page }: Shell): string {
  const { file, name } = page.world.manifest.peek() ?? {};
  return file?.split("/").at(-1) ?? `${name ?? "world"}.sdf`;
}

function report(shell: Shell, file: string | undefined, lost: readonly string[]): void {
  const done = file === undefined ? "downloaded" : `saved as ${file}`;
  if (lost.length === 0) shell.notices.report("World", done, "ok");
  else shell.notices.report("World", `${done}, but it does not hold: ${lost.join("; ")}`, "warn");
}
