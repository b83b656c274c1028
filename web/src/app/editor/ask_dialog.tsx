/** Asks before an action that cannot be undone. */

import type { JSX } from "preact";

import { Dialog } from "../dialogs/dialog";
import type { Shell } from "../shell";
import type { Question } from "./model_editor";

export function AskDialog({ shell, question }: { readonly shell: Shell; readonly question: Question }): JSX.Element {
  const close = (): void => {
    shell.editor.question.value = null;
  };
  return (
    <Dialog title={question.title} class="ask" onClose={close}>
      <form
        onSubmit={(event) => {
          event.preventDefault();
          close();
          question.run();
        }}
      >
        <p>{question.text}</p>
        <div class="foot">
          <span class="sp" />
          <button type="submit" class="b pri">
            {question.action}
          </button>
        </div>
      </form>
    </Dialog>
  );
}
