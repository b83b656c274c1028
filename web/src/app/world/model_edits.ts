/** Edits of whole models: held in the air, copied, deleted. */

import { Vector3, type Box3 } from "three";

import type { ModelInfo } from "../../protocol/generated/page_messages";
import { selectOnceAdded } from "../insert/insertion";
import type { Request } from "../../protocol/connection";
import type { Command, Page, Selection } from "../../page/page";
import type { Shell } from "../shell";
import { canEdit, editWorld } from "./edits";
import { bodiesOf } from "../../page/world_nodes";
import { findModel } from "../../page/selection_lookup";

/** Gap between a model and its copy [m]. */
const GAP = 0.1;

/** Fix a model's base where it is, or free it. */
export function holdModel(shell: Shell, model: string, on: boolean): void {
  void editWorld(shell, `${on ? "Hold" : "Release"} of ${model}`, "hold", { model, on }, { model, on: !on });
}

/** Reset a model's pose, joints, velocities and plugins to their initial state. */
export function resetModel(shell: Shell, model: string): void {
  const reset: Request = { request: "reset_model", fields: { model } };
  void change(shell, `Reset of ${model}`, reset, { request: "undo_reset", fields: { model } });
}

/** Put a copy beside a model, or onto a point of the world [m], and select it. */
export function copyModel(shell: Shell, model: string, at: Vector3 | null = null): void {
  const { page } = shell;
  const outer = outermost(page, model);
  if (outer === null) return;
  const name = freeName(page, outer.name);
  const worldFromFixed = page.scene.world.matrixWorld.clone().invert();
  const offset = copyOffset(page.world.bounds(bodiesOf(outer)).applyMatrix4(worldFromFixed), at).toArray();
  const copy: Request = { request: "copy", fields: { model: outer.name, name, offset } };
  const remove: Request = { request: "delete", fields: { model: name } };
  const restore: Request = { request: "restore", fields: { model: name } }; // redo brings back the copy with its later changes
  void change(shell, `Copy of ${outer.name}`, copy, remove, restore).then((isDone) => {
    if (isDone) selectOnceAdded(page, { kind: "model", model: name });
  });
}

/** Offset from a model within bounds to its copy next to it, or on a point [m]. */
function copyOffset(bounds: Box3, at: Vector3 | null): Vector3 {
  if (at === null) return new Vector3(bounds.max.x - bounds.min.x + GAP, 0, 0);
  const foot = bounds.getCenter(new Vector3()).setZ(bounds.min.z);
  return at.clone().sub(foot);
}

/** Delete a model, with its sensors and plugins. */
export function deleteModel(shell: Shell, model: string): void {
  const outer = outermost(shell.page, model);
  if (outer === null) return;
  const remove: Request = { request: "delete", fields: { model: outer.name } };
  void change(shell, `Delete ${outer.name}`, remove, { request: "restore", fields: { model: outer.name } });
}

/** Delete a light of the world itself. */
export function deleteLight(shell: Shell, light: string): void {
  void change(
    shell,
    `Delete ${light}`,
    { request: "delete_light", fields: { light } },
    { request: "restore_light", fields: { light } },
  );
}

/** Commands for the selected model or light. */
export function modelCommands(shell: Shell): readonly Command[] {
  const selected = (): string | null => modelOf(shell.page.selection.peek());
  const command = (id: string, title: string, keys: string | null, run: (model: string) => void): Command => ({
    id,
    title,
    group: "Simulation",
    ...(keys === null ? {} : { keys }),
    enabled: () => canEdit(shell) && selected() !== null,
    run: () => run(selected() ?? ""),
  });
  return [
    command("copy_model", "Copy the selected model", "Shift C", (model) => copyModel(shell, model)),
    command("reset.model", "Reset the selected model only", null, (model) => resetModel(shell, model)),
    command("delete_model", "Delete the selected model", "Delete", (model) => deleteModel(shell, model)),
    command("hold_model", "Hold the selected model in the air, or free it", "H", (model) =>
      holdModel(shell, model, outermost(shell.page, model)?.held !== true),
    ),
  ];
}

/** Make an edit that a request of another kind undoes, and `again` redoes; resolves with true if it was done. */
function change(shell: Shell, ...edit: Change): Promise<boolean> {
  return shell.page.undo.ask(changeAndRecord(shell, ...edit));
}

type Change = readonly [title: string, after: Request, before: Request, again?: Request];

async function changeAndRecord(shell: Shell, ...[title, after, before, again = after]: Change): Promise<boolean> {
  try {
    await shell.page.connection.request(after.request, after.fields);
  } catch (error) {
    shell.notices.report(title, error instanceof Error ? error.message : String(error));
    return false;
  }
  const send =
    ({ request, fields }: Request) =>
    (): void =>
      shell.request(title, request, fields);
  shell.page.undo.record(title, send(again), send(before));
  return true;
}

function modelOf(selection: Selection | null): string | null {
  return selection?.kind === "model" || selection?.kind === "link" ? selection.model : null;
}

/** The model of the world that a name, `outer::inner`, is in. */
function outermost(page: Page, name: string): ModelInfo | null {
  const models = page.world.manifest.peek()?.models ?? [];
  return models.find((model) => `${name}::`.startsWith(`${model.name}::`)) ?? null;
}

function freeName(page: Page, name: string): string {
  let number = 0;
  while (findModel(page, `${name}_${number}`) !== null) number += 1;
  return `${name}_${number}`;
}
