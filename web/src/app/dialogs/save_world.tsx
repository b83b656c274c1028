/** Dialog that saves the world as SDF, with changes that were made while it ran. */

import type { JSX } from "preact";

import { saveFile } from "../../panels/use";
import type { Command } from "../../page/page";
import type { Shell } from "../shell";
import { canEdit } from "../world/edits";
import { SaveFile } from "./save_file";

export function saveCommands(shell: Shell): readonly Command[] {
  if (!canEdit(shell)) return [];
  const open = (): void => {
    shell.dialog.value = "save_world";
  };
  return [{ id: "save_world", title: "Save the world as SDF", group: "Simulation", keys: "Ctrl S", run: open }];
}

export function SaveWorld({ shell }: { readonly shell: Shell }): JSX.Element {
  const { connection, world } = shell.page;
  return (
    <SaveFile
      shell={shell}
      title="Save the world as SDF"
      kind="File"
      offered={world.manifest.value?.file ?? null}
      note="The world is saved with its changes and current poses. It starts at rest, at time 0."
      save={async (file, replace) => {
        const answer = await connection.request("save_world", { file, replace });
        if ("exists" in answer) return answer;
        if ("file" in answer) report(shell, `saved as ${answer.file}`, answer.lost);
        return null;
      }}
      download={async () => {
        const answer = await connection.request("save_world", { file: null });
        if (!("sdf" in answer)) return;
        saveFile(downloadName(shell), new Blob([answer.sdf], { type: "application/xml" }));
        report(shell, "downloaded", answer.lost);
      }}
    />
  );
}

function downloadName({ page }: Shell): string {
  const { file, name } = page.world.manifest.peek() ?? {};
  return file?.split("/").at(-1) ?? `${name ?? "world"}.sdf`;
}

function report(shell: Shell, done: string, lost: readonly string[]): void {
  if (lost.length === 0) shell.notices.report("World", done, "ok");
  else shell.notices.report("World", `${done}, but without: ${lost.join("; ")}`, "warn");
}
