/** The .rviz file: how much it was changed, and how to save it. */

import type { JSX } from "preact";

import { saveFile, sentence } from "../panels/use";
import { Button } from "../theme/button";
import { count } from "../theme/format";
import type { Shell } from "./shell";

export function RvizFoot({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const { displays, session } = shell.page;
  const changes = displays.changes.value;
  if (session.rviz === null || changes === 0) return null;
  const { name, writable } = session.rviz;
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

/** Write the file that the page was started with, or hand the text to the browser. */
export function save(shell: Shell): void {
  const { connection, displays, session } = shell.page;
  const text = displays.save();
  if (session.rviz?.writable === true) {
    connection.request("save_rviz", { text }).then(() => displays.markSaved(), (error: unknown) => shell.notices.report("Save", sentence(error)));
  } else {
    const name = session.rviz?.name ?? `${session.title}.rviz`;
    saveFile(name.split("/").at(-1) ?? name, new Blob([text], { type: "text/yaml" }));
    displays.markSaved();
  }
}
