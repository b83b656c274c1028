/** The notice: one line with counts, and a button that opens the list. */

import type { JSX } from "preact";

import { Button } from "../../theme/button";
import { StatusShape } from "../../theme/status_shape";
import type { Shell } from "../shell";

export function NoticeLine({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const { notices } = shell;
  const { level, text } = notices.line.value;
  return (
    <div class={text === "" ? "sr" : "notice float"} role="status">
      {text !== "" && (
        <>
          <StatusShape level={level} />
          <span class="said">{text}</span>
          <span class="sp" />
          <Button class="lk" onClick={() => (shell.dialog.value = "notices")}>
            Details
          </Button>
          <Button icon="close" label="Dismiss" onClick={() => notices.dismiss()} />
        </>
      )}
    </div>
  );
}
