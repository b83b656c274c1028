/** The link to the current view, to be copied; one of its own kind only allows looking. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useMemo, useRef } from "preact/hooks";

import { Button } from "../../theme/button";
import { Dialog } from "./dialog";
import type { Shell } from "../shell";
import { linkTo } from "../views/view_link";

const TEXTS = {
  control: "People with this link get this view, and can drive and change everything.",
  look: "People with this link get this view, and cannot drive or change anything.",
};

export function LinkDialog({ shell }: { readonly shell: Shell }): JSX.Element {
  const field = useRef<HTMLInputElement>(null);
  const copied = useSignal(false);
  const { session, views } = shell.page;
  const looks = useSignal(session.view_only);
  const link = useMemo(
    () => linkTo(views, location.href, (looks.value ? null : session.token) ?? session.view_token),
    [views, session, looks.value],
  );
  const copy = (): void => {
    field.current?.select();
    if (!window.isSecureContext) return; // Ctrl C copies the selection
    void navigator.clipboard.writeText(link).then(
      () => (copied.value = true),
      () => undefined,
    );
  };
  return (
    <Dialog title="Link to this view" class="save" onClose={() => (shell.dialog.value = null)}>
      <div class="form">
        {!session.view_only && (
          <div role="group" aria-label="Rights of the link">
            <Button small on={!looks.value} onClick={() => (looks.value = false)}>
              View and control
            </Button>
            <Button small on={looks.value} onClick={() => (looks.value = true)}>
              Look only
            </Button>
          </div>
        )}
        <p class="t2">{looks.value ? TEXTS.look : TEXTS.control}</p>
        <label class="field">
          <input
            ref={field}
            aria-label="Link"
            readOnly
            value={link}
            autoFocus
            onFocus={(event) => event.currentTarget.select()}
          />
        </label>
      </div>
      <div class="foot">
        <span class="sm t2" role="status">
          {copied.value && "Copied."}
        </span>
        <span class="sp" />
        <Button tone="line" onClick={copy}>
          {window.isSecureContext ? "Copy" : "Select"}
        </Button>
      </div>
    </Dialog>
  );
}
