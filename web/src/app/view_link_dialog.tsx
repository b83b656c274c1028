/** The link to the current view, to be copied. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useMemo, useRef } from "preact/hooks";

import { Button } from "../theme/button";
import { Dialog } from "./dialog";
import type { Shell } from "./shell";
import { linkTo } from "./view_link";

export function LinkDialog({ shell }: { readonly shell: Shell }): JSX.Element {
  const field = useRef<HTMLInputElement>(null);
  const copied = useSignal(false);
  const link = useMemo(() => linkTo(shell.page.views, location.href), [shell]);
  const copy = (): void => {
    field.current?.select();
    if (!window.isSecureContext) return; // Ctrl C copies what is selected
    void navigator.clipboard.writeText(link).then(() => (copied.value = true), () => undefined);
  };
  return (
    <Dialog title="Link to this view" class="save" onClose={() => (shell.dialog.value = null)}>
      <div class="form">
        <p class="t2">Whoever can open this page sees it from here.</p>
        <label class="field">
          <input ref={field} aria-label="Link" readOnly value={link} autoFocus onFocus={(event) => event.currentTarget.select()} />
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
