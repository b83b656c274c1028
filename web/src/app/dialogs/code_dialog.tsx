/** Asks before a model's own code is run. */

import type { JSX } from "preact";

import { Button } from "../../theme/button";
import { Dialog } from "./dialog";
import type { CodeConsent } from "../insert/insertion";
import type { Shell } from "../shell";

export function CodeDialog({ shell, code }: { readonly shell: Shell; readonly code: CodeConsent }): JSX.Element {
  const close = (): void => {
    shell.insertion.consentRequest.value = null;
  };
  const agree = (): void => {
    close();
    code.agree();
  };
  return (
    <Dialog title={`Run the code of ${code.title}?`} class="save" onClose={close}>
      <div class="form">
        <p>
          Its plugins are programs. They would run where the simulation runs, with the rights of the person who started
          it:
        </p>
        {code.files.map((file) => (
          <code key={file} class="sm">
            {file}
          </code>
        ))}
      </div>
      <div class="foot">
        <span class="sp" />
        <Button onClick={close}>Cancel</Button>
        <Button tone="primary" onClick={agree}>
          Insert and run it
        </Button>
      </div>
    </Dialog>
  );
}
