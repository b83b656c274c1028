/** Edits of the running world, which can be undone. */

import type { SimulatedWorld } from "../../scene/simulated_world";
import type { WorldEditor } from "../../page/world_editor";
import { canControl } from "../../page/view_only";
import type { Fields, RequestName } from "../../protocol/connection";
import type { Shell } from "../shell";

/**
 * Ask the server for an edit.
 *
 * `before` are the fields that undo the edit. A refused edit is not recorded.
 */
export function editWorld<N extends RequestName>(shell: Shell, ...edit: Edit<N>): Promise<void> {
  return shell.page.undo.ask(editAndRecord(shell, ...edit));
}

type Edit<N extends RequestName> = readonly [title: string, request: N, after: Fields<N>, before: Fields<N>];

async function editAndRecord<N extends RequestName>(
  shell: Shell,
  ...[title, request, after, before]: Edit<N>
): Promise<void> {
  try {
    await shell.page.connection.request(request, after);
  } catch (error) {
    shell.notices.report(title, error instanceof Error ? error.message : String(error));
    return;
  }
  const send = (fields: Fields<N>) => (): void => shell.request(title, request, fields);
  shell.page.undo.record(title, send(after), send(before));
}

/** Editor that tools change the world with; `shell` returns the shell once the page is drawn. */
export function makeEditor(world: SimulatedWorld, shell: () => Shell): WorldEditor {
  return {
    world,
    ask: (title, request, fields) =>
      shell()
        .page.connection.request(request, fields)
        .then(
          () => true,
          (error: unknown) => {
            shell().notices.report(title, error instanceof Error ? error.message : String(error));
            return false;
          },
        ),
    edit: (...edit) => editWorld(shell(), ...edit),
  };
}

/** True if the page shows a running simulation that may be changed. */
export function canEdit(shell: Shell): boolean {
  return shell.page.session.kind === "simulation" && canControl(shell.page);
}
