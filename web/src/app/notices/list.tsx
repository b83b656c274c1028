/** The notice's list: every fault with its reason and what to do. */

import type { JSX } from "preact";

import { Button } from "../../theme/button";
import { StatusShape } from "../../theme/status_shape";
import { Dialog } from "../dialogs/dialog";
import { displayKey } from "../displays/display_rows";
import { isSilence, type Notice } from "./notices";
import type { Shell } from "../shell";

export function NoticeList({ shell }: { readonly shell: Shell }): JSX.Element {
  const close = (): void => {
    shell.dialog.value = null;
  };
  const notices = shell.notices.all.value;
  return (
    <Dialog title="Problems" class="notices" onClose={close}>
      <div class="scroll" tabIndex={0}>
        {notices.length === 0 && <p class="empty">No problems.</p>}
        {notices.map((notice, index) => (
          <Entry key={index} shell={shell} notice={notice} onClose={close} />
        ))}
      </div>
    </Dialog>
  );
}

function Entry({
  shell,
  notice,
  onClose,
}: {
  readonly shell: Shell;
  readonly notice: Notice;
  readonly onClose: () => void;
}): JSX.Element {
  const { display } = notice;
  const show = (): void => {
    if (display === undefined) return;
    onClose();
    shell.layout.open("displays");
    shell.display.value = display;
    shell.openDisplays.value = new Map(shell.openDisplays.peek()).set(displayKey(display), true);
  };
  return (
    <div class="fault-row">
      <StatusShape level={isSilence(notice) ? "none" : notice.level} />
      <span>
        <b>{notice.title}</b> {notice.text}
        {notice.advice !== undefined && <span class="advice">{notice.advice}</span>}
      </span>
      <span class="sp" />
      {display !== undefined && (
        <Button small tone="line" onClick={show}>
          Show
        </Button>
      )}
    </div>
  );
}
