/** Saving as an .rviz file below the folder where Trundle was started; a file that is there is replaced only if asked for. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";

import { sentence } from "../../panels/use";
import { Button } from "../../theme/button";
import { Dialog } from "./dialog";
import { newName, rvizFile } from "../displays/rviz_foot";
import type { Shell } from "../shell";

export function SaveDialog({ shell }: { readonly shell: Shell }): JSX.Element {
  const name = useSignal(rvizFile(shell)?.name ?? newName(shell));
  const taken = useSignal<string | null>(null); // name of a file that is there
  const fault = useSignal("");
  const isTaken = taken.value === fileName(name.value);
  const close = (): void => {
    shell.dialog.value = null;
  };
  const save = async (): Promise<void> => {
    const { connection, displays } = shell.page;
    const file = fileName(name.peek());
    try {
      if (!(await connection.saveRvizAs(file, displays.save(), taken.peek() === file))) {
        taken.value = file;
        return;
      }
    } catch (error) {
      fault.value = sentence(error);
      return;
    }
    displays.markSaved();
    shell.ownFile.value = { name: file, writable: true };
    close();
  };
  const said = isTaken ? `${fileName(name.value)} is there already.` : fault.value;
  return (
    <Dialog title="Save as .rviz" class="save" onClose={close}>
      <div class="form">
        <label class={`field${said === "" ? "" : " wrong"}`}>
          <input
            aria-label="File name"
            aria-invalid={said !== ""}
            value={name.value}
            spellcheck={false}
            autocomplete="off"
            autoFocus
            onFocus={(event) => event.currentTarget.setSelectionRange(0, name.peek().lastIndexOf("."))}
            onInput={(event) => {
              name.value = event.currentTarget.value;
              fault.value = "";
            }}
            onKeyDown={(event) => event.key === "Enter" && !isTaken && void save()}
          />
        </label>
        {said !== "" && (
          <span class="fault" role="alert">
            {said}
          </span>
        )}
        <p class="t2 sm">In the folder where Trundle was started, or in one below it.</p>
      </div>
      <div class="foot">
        <span class="sp" />
        <Button onClick={close}>Cancel</Button>
        <Button tone="primary" onClick={() => void save()}>
          {isTaken ? "Replace it" : "Save"}
        </Button>
      </div>
    </Dialog>
  );
}

/** What was typed, with rviz's ending. */
function fileName(typed: string): string {
  const name = typed.trim();
  return name === "" || name.endsWith(".rviz") ? name : `${name}.rviz`;
}
