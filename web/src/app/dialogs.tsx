/** The dialog that is open. */

import type { JSX } from "preact";

import { Help } from "./help";
import { NoticeList } from "./notice_list";
import { Palette } from "./palette";
import type { Shell } from "./shell";

export function Dialogs({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const dialog = shell.dialog.value;
  if (dialog === "palette") return <Palette shell={shell} />;
  if (dialog === "help") return <Help shell={shell} />;
  return dialog === "notices" ? <NoticeList shell={shell} /> : null;
}
