/** Asks for a name below the folder where Trundle was started, and before a file is replaced. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";

import { sentence } from "../../panels/use";
import type { FilesExist } from "../../protocol/generated/page_messages";
import { Button } from "../../theme/button";
import type { Shell } from "../shell";
import { Dialog } from "./dialog";

export interface SaveFileProps {
  readonly shell: Shell;
  readonly title: string;
  readonly kind: "File" | "Folder";
  /** Proposed name; null: the folder cannot be written. */
  readonly offered: string | null;
  /** Extension that is added to a name without one. */
  readonly ending?: string;
  readonly note: string;
  /** Saves; returns the files that exist already; null: saved. */
  readonly save: (name: string, replace: boolean) => Promise<FilesExist | null>;
  readonly download?: () => Promise<void> | void;
}

export function SaveFile({
  shell,
  title,
  kind,
  offered,
  ending = "",
  note,
  save,
  download,
}: SaveFileProps): JSX.Element {
  const name = useSignal(offered ?? "");
  const exists = useSignal<string | null>(null);
  const fault = useSignal("");
  const isBusy = useSignal(false);
  const whole = (): string => `${name.value.trim()}${name.value.trim().endsWith(ending) ? "" : ending}`;
  const run = async (work: () => Promise<FilesExist | null>): Promise<void> => {
    isBusy.value = true;
    fault.value = "";
    try {
      exists.value = (await work())?.exists ?? null;
      if (exists.value === null) shell.dialog.value = null;
    } catch (error) {
      fault.value = sentence(error);
    } finally {
      isBusy.value = false;
    }
  };
  const isUsable = offered !== null && name.value.trim() !== "" && !isBusy.value;
  const message = exists.value === null ? fault.value : question(exists.value);
  return (
    <Dialog title={title} class="ask" onClose={() => (shell.dialog.value = null)}>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          if (isUsable && exists.peek() === null) void run(() => save(whole(), false)); // Enter never replaces a file
        }}
      >
        {offered === null ? (
          <p>
            The folder where Trundle was started cannot be written.{download !== undefined && " It can be downloaded."}
          </p>
        ) : (
          <label>
            {kind}, below the folder where Trundle was started
            <span class={`field${message === "" ? "" : " wrong"}`}>
              <input
                aria-label={kind}
                aria-invalid={message !== ""}
                value={name.value}
                spellcheck={false}
                autocomplete="off"
                autoFocus
                onFocus={({ currentTarget: { value }, currentTarget }) =>
                  currentTarget.setSelectionRange(
                    value.lastIndexOf("/") + 1,
                    value.includes(".") ? value.lastIndexOf(".") : value.length,
                  )
                }
                onInput={(event) => {
                  name.value = event.currentTarget.value;
                  exists.value = null;
                  fault.value = "";
                }}
              />
            </span>
          </label>
        )}
        {message !== "" && (
          <p class="fault" role="alert">
            {message}
          </p>
        )}
        <p class="sm t2">{note}</p>
        <div class="foot">
          {download !== undefined && (
            <Button
              icon="download"
              tone={offered === null ? "primary" : "line"}
              disabled={isBusy.value}
              onClick={() => void run(async () => (await download(), null))}
            >
              Download
            </Button>
          )}
          <span class="sp" />
          {exists.value !== null ? (
            <Button tone="primary" disabled={!isUsable} onClick={() => void run(() => save(whole(), true))}>
              Replace
            </Button>
          ) : (
            offered !== null && (
              <button type="submit" class="b pri" disabled={!isUsable}>
                Save
              </button>
            )
          )}
        </div>
      </form>
    </Dialog>
  );
}

function question(files: string): string {
  return files.includes(", ") ? `${files} exist already. Replace them?` : `${files} exists already. Replace it?`;
}
