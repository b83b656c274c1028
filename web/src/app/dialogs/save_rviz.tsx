/** Dialog that saves the displays as an .rviz file. */

import type { JSX } from "preact";

import { download, newName, rvizFile } from "../displays/rviz_foot";
import type { Shell } from "../shell";
import { SaveFile } from "./save_file";

export function SaveRviz({ shell }: { readonly shell: Shell }): JSX.Element {
  const { connection, displays } = shell.page;
  return (
    <SaveFile
      shell={shell}
      title="Save as .rviz"
      kind="File"
      offered={rvizFile(shell)?.name ?? newName(shell)}
      ending=".rviz"
      note="Displays, views and tools, in rviz's format."
      save={async (file, replace) => {
        const answer = await connection.request("save_rviz_as", { file, text: displays.save(), replace });
        if ("exists" in answer) return answer;
        displays.markSaved();
        shell.openedFile.value = { name: answer.file, writable: true };
        return null;
      }}
      download={() => download(shell)}
    />
  );
}
