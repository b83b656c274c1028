/** Uploads a model: a file, a .zip or a folder, chosen or dropped. */

import type { JSX } from "preact";

import { Button } from "../../theme/button";
import { Icon } from "../../theme/icons";
import { chooseModel } from "../insert/model_files";
import type { Shell } from "../shell";
import { Dialog } from "./dialog";

export function UploadDialog({ shell }: { readonly shell: Shell }): JSX.Element {
  const { upload } = shell.insertion;
  const isBusy = upload.title.value !== null;
  const choose = (what: "file" | "folder"): void => chooseModel(what, (files) => void upload.send(files));
  return (
    <Dialog title="Upload a model" class="save" onClose={() => (shell.dialog.value = null)}>
      <div class="form">
        <div class="drop">
          <Icon name="upload" />
          <span role="status">{isBusy ? `Uploading ${upload.title.value ?? ""}` : "Drop a .zip, a folder, an .sdf or an .urdf here"}</span>
          <div class="choices">
            <Button tone="line" disabled={isBusy} onClick={() => choose("file")}>
              Choose a file
            </Button>
            <Button tone="line" disabled={isBusy} onClick={() => choose("folder")}>
              Choose a folder
            </Button>
          </div>
        </div>
        {upload.fault.value !== "" && (
          <span class="fault" role="alert">
            {upload.fault.value}
          </span>
        )}
        <p class="t2 sm">A model is a folder with model.config, or one .sdf or .urdf file, and their meshes. It can be inserted until Trundle ends.</p>
      </div>
    </Dialog>
  );
}
