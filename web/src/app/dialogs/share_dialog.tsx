/** Links to this page for other people and devices, as text to copy and as a QR code. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useMemo, useRef } from "preact/hooks";

import { Button } from "../../theme/button";
import { Select } from "../../theme/select";
import type { Shell } from "../shell";
import { linkTo, shareableOrigins } from "../views/view_link";
import { Dialog } from "./dialog";
import { QrCode } from "./qr_code";

const TEXTS = {
  control: "Whoever has this link can drive the robot and change everything, as you can.",
  look: "Whoever has this link sees this view, and can neither drive nor change anything.",
  local:
    "Only this computer reaches the page. For a phone or another computer in your network, start Trundle with " +
    "--host 0.0.0.0.",
};

export function ShareDialog({ shell }: { readonly shell: Shell }): JSX.Element {
  const field = useRef<HTMLInputElement>(null);
  const copied = useSignal(false);
  const { session, views } = shell.page;
  const looks = useSignal(session.view_only);
  const origins = shareableOrigins(location, session.network_urls);
  const origin = useSignal(origins[0] ?? location.origin);
  const token = (looks.value ? null : session.token) ?? session.view_token;
  const link = useMemo(
    () => linkTo(views, new URL(location.pathname, origin.value).href, token),
    [views, token, origin.value],
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
    <Dialog title="Share" class="save share" onClose={() => (shell.dialog.value = null)}>
      <div class="form">
        {!session.view_only && (
          <div role="group" aria-label="Permissions of the link">
            <Button small on={!looks.value} onClick={() => (looks.value = false)}>
              View and control
            </Button>
            <Button small on={looks.value} onClick={() => (looks.value = true)}>
              View only
            </Button>
          </div>
        )}
        <p class="t2">{looks.value ? TEXTS.look : TEXTS.control}</p>
        {origins.length > 1 && (
          <label class="row">
            Address of this computer
            <Select
              label="Address of this computer"
              value={origin.value}
              choices={origins}
              onChange={(value) => (origin.value = value)}
            />
          </label>
        )}
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
        {origins.length > 0 ? (
          <QrCode label="Link as a QR code" text={`${origin.value}/?token=${token}`} />
        ) : (
          <p class="t2">{TEXTS.local}</p>
        )}
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
