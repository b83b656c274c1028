/** The dialog that is open. */

import type { JSX } from "preact";

import { AskDialog } from "../editor/ask_dialog";
import { SaveModel } from "../editor/save_model";
import { CodeDialog } from "./code_dialog";
import { Help } from "./help";
import { NoticeList } from "../notices/list";
import { Palette } from "./palette";
import { PictureDialog } from "./picture_dialog";
import { SaveRviz } from "./save_rviz";
import { SaveWorld } from "./save_world";
import { ShareDialog } from "./share_dialog";
import type { Shell } from "../shell";
import { TimeDialog } from "./time_dialog";
import { UploadDialog } from "./upload_dialog";

export function Dialogs({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const dialog = shell.dialog.value;
  const question = shell.editor.question.value;
  if (question !== null) return <AskDialog shell={shell} question={question} />;
  const code = shell.insertion.consentRequest.value;
  if (code !== null) return <CodeDialog shell={shell} code={code} />;
  if (dialog === "palette") return <Palette shell={shell} />;
  if (dialog === "help") return <Help shell={shell} />;
  if (dialog === "picture") return <PictureDialog shell={shell} />;
  if (dialog === "share") return <ShareDialog shell={shell} />;
  if (dialog === "upload") return <UploadDialog shell={shell} />;
  if (dialog === "time") return <TimeDialog shell={shell} />;
  if (dialog === "save") return <SaveRviz shell={shell} />;
  if (dialog === "save_world") return <SaveWorld shell={shell} />;
  if (dialog === "save_model") return <SaveModel shell={shell} />;
  return dialog === "notices" ? <NoticeList shell={shell} /> : null;
}
