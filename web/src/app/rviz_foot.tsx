/** The .rviz file: how much it was changed, and how to save it. */

import type { JSX } from "preact";

import { saveFile, sentence } from "../panels/use";
import { Button } from "../theme/button";
import { count } from "../theme/format";
import type { Shell } from "./shell";

export function RvizFoot({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const file = rvizFile(shell);
  const changes = shell.page.displays.changes.value;
  if (file === null || changes === 0) return null;
  const { name, writable } = file;
  return (
    <div class="foot">
      <span class="sm t2 n" data-tip={name}>
        {count(changes, "change")}, not saved
      </span>
      <span class="sp" />
      <Button small tone="line" onClick={() => save(shell)}>
        {writable ? "Save" : "Download"}
      </Button>
    </div>
  );
}

/** What the displays were read from: what a person has opened, which the browser cannot write, or the session's file. */
export function rvizFile({ opened, page }: Shell): { readonly name: string; readonly writable: boolean } | null {
  return opened.value === null ? page.session.rviz : { name: opened.value, writable: false };
}

/** Write the file that the page was started with, or hand the text to the browser. */
export function save(shell: Shell): void {
  const { connection, displays, session } = shell.page;
  const text = displays.save();
  const file = rvizFile(shell);
  if (file?.writable === true) {
    connection.request("save_rviz", { text }).then(() => displays.markSaved(), (error: unknown) => shell.notices.report("Save", sentence(error)));
  } else {
    const name = file?.name ?? `${session.title}.rviz`;
    saveFile(name.split("/").at(-1) ?? name, new Blob([text], { type: "text/yaml" }));
    displays.markSaved();
  }
}
