/** Uploads a model: a file, a .zip or a folder, chosen or dropped. */

import type { JSX } from "preact";

import { bytes } from "../../panels/messages/format";
import { Button } from "../../theme/button";
import { Icon } from "../../theme/icons";
import { chooseModel } from "../insert/model_files";
import type { ModelUpload } from "../insert/model_upload";
import type { Shell } from "../shell";
import { Dialog } from "./dialog";

export function UploadDialog({ shell }: { readonly shell: Shell }): JSX.Element {
  const { upload } = shell.insertion;
  const title = upload.title.value;
  const choose = (kind: "file" | "folder"): void => chooseModel(kind, (files) => void upload.send(files));
  return (
    <Dialog title="Upload a model" class="save" onClose={() => (shell.dialog.value = null)}>
      <div class="form">
        <div class="drop">
          <Icon name="upload" />
          {title === null ? <Choices choose={choose} /> : <Sending title={title} upload={upload} />}
        </div>
        {upload.fault.value !== "" && (
          <span class="fault" role="alert">
            {upload.fault.value}
          </span>
        )}
        <p class="t2 sm">
          A model is a folder with model.config, or one .sdf or .urdf file, and their meshes. It can be inserted until
          Trundle ends; a world that is saved with it gets a copy.
        </p>
      </div>
    </Dialog>
  );
}

function Choices({ choose }: { readonly choose: (kind: "file" | "folder") => void }): JSX.Element {
  return (
    <>
      <span>Drop a .zip, a folder, an .sdf or an .urdf here</span>
      <div class="choices">
        <Button tone="line" onClick={() => choose("file")}>
          Choose a file
        </Button>
        <Button tone="line" onClick={() => choose("folder")}>
          Choose a folder
        </Button>
      </div>
    </>
  );
}

/** Progress of an upload; after the last byte the server checks the model. */
function Sending({ title, upload }: { readonly title: string; readonly upload: ModelUpload }): JSX.Element {
  const progress = upload.progress.value;
  const isSent = progress !== null && progress.sent >= progress.total;
  return (
    <>
      <span role="status">{isSent ? `Looking into ${title}` : `Uploading ${title}`}</span>
      <progress aria-label="Sent" value={progress === null ? 0 : progress.sent / progress.total} />
      <span class="t2 sm">{progress === null ? "" : `${bytes(progress.sent)} of ${bytes(progress.total)}`}</span>
      <div class="choices">
        <Button tone="line" onClick={() => upload.cancel()}>
          Cancel
        </Button>
      </div>
    </>
  );
}
