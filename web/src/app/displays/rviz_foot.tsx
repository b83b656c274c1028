/** The .rviz file: number of its changes, and buttons that save it. */

import type { JSX } from "preact";

import { saveFile, sentence } from "../../panels/use";
import { Button } from "../../theme/button";
import { count } from "../../theme/format";
import { canControl } from "../../page/view_only";
import type { RvizFileInfo, Shell } from "../shell";

export function RvizFoot({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const file = rvizFile(shell);
  const changes = shell.page.displays.changes.value;
  if (changes === 0) return null;
  return (
    <div class="foot">
      <span class="sm t2 n" data-tip={file?.name}>
        {count(changes, "change")}, not saved
      </span>
      <span class="sp" />
      {file?.writable === true && canControl(shell.page) ? (
        <Button small tone="line" onClick={() => save(shell)}>
          Save
        </Button>
      ) : (
        <>
          <Button small onClick={() => download(shell)}>
            Download
          </Button>
          {canControl(shell.page) && (
            <Button small tone="line" onClick={() => (shell.dialog.value = "save")}>
              Save as
            </Button>
          )}
        </>
      )}
    </div>
  );
}

/** File that the displays were last loaded from or saved to; null: no file. */
export function rvizFile({ openedFile, page }: Shell): RvizFileInfo | null {
  return openedFile.value ?? page.session.rviz;
}

/** Name for a new file: the robot's name, else the page's title. */
export function newName({ robot, page }: Shell): string {
  const name = robot.value ?? page.session.title.replace(/\.\w+$/, "");
  return `${name.replace(/[\s/\\]+/g, "_")}.rviz`;
}

/** Write the file that the page was started with, or that the person saved last. */
export function save(shell: Shell): void {
  const { connection, displays } = shell.page;
  const text = displays.save();
  const { rviz } = shell.page.session;
  const saved = shell.openedFile.peek() ?? (rviz?.saved === true ? rviz : null);
  const done =
    saved === null
      ? connection.request("save_rviz", { text })
      : connection.request("save_rviz_as", { file: saved.name, text, replace: true });
  done.then(
    () => displays.markSaved(),
    (error: unknown) => shell.notices.report("Save", sentence(error)),
  );
}

/** Download the file's text. */
export function download(shell: Shell): void {
  const { displays } = shell.page;
  const name = rvizFile(shell)?.name ?? newName(shell);
  saveFile(name.split("/").at(-1) ?? name, new Blob([displays.save()], { type: "text/yaml" }));
  displays.markSaved();
}
