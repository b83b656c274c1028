/** Dialog that saves the edited model: model.sdf and model.config, below the folder where Trundle was started. */

import type { JSX } from "preact";

import { SaveFile } from "../dialogs/save_file";
import type { Shell } from "../shell";

export function SaveModel({ shell }: { readonly shell: Shell }): JSX.Element {
  return (
    <SaveFile
      shell={shell}
      title="Save the model"
      kind="Folder"
      offered={shell.editor.draft.value?.folder ?? null}
      note="It gets model.sdf and model.config."
      save={async (folder, replace) => {
        const answer = await shell.page.connection.request("draft_save", { folder, replace });
        if ("exists" in answer) return answer;
        shell.notices.report("Model", `saved in ${answer.file}`, "ok");
        return null;
      }}
    />
  );
}
