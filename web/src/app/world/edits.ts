/** Edits of the running world: what the server has done can be undone. */

import { Euler, Quaternion, type Vector3 } from "three";

import type { SimulatedWorld } from "../../scene/simulated_world";
import type { WorldEditor } from "../../tools/world_editor";
import { canControl } from "../looking";
import type { Page } from "../page";
import type { Shell } from "../shell";

/** Fields of a request. */
export type Fields = Parameters<Page["connection"]["request"]>[1];

/**
 * Ask the server for an edit.
 *
 * `before` are the fields that take it back. Nothing can be undone that was refused.
 */
export async function editWorld(shell: Shell, title: string, request: string, after: Fields, before: Fields): Promise<void> {
  try {
    await shell.page.connection.request(request, after);
  } catch (error) {
    shell.notices.report(title, error instanceof Error ? error.message : String(error));
    return;
  }
  const send = (fields: Fields) => (): void => shell.request(title, request, fields);
  shell.page.undo.record(title, send(after), send(before));
}

/** What the tools change the world by; `shell` is there once the page is drawn. */
export function makeEditor(world: SimulatedWorld, shell: () => Shell): WorldEditor {
  return {
    world,
    ask: (title, request, fields) =>
      shell().page.connection.request(request, fields).then(
        () => true,
        (error: unknown) => {
          shell().notices.report(title, error instanceof Error ? error.message : String(error));
          return false;
        },
      ),
    edit: (...edit) => editWorld(shell(), ...edit),
  };
}

/** True if what is shown is simulated now, and can be changed. */
export function canEdit(shell: Shell): boolean {
  return shell.page.session.kind === "simulation" && canControl(shell.page);
}

/** A pose as requests have it: position [m] and a quaternion wxyz. */
export function poseFields(position: Vector3, { x, y, z, w }: Quaternion): { position: number[]; orientation: number[] } {
  return { position: position.toArray(), orientation: [w, x, y, z] };
}

/** The orientation R = Rz(yaw) Ry(pitch) Rx(roll) [rad], as URDF and SDF have it. */
export function orientationOf([roll, pitch, yaw]: readonly [number, number, number]): Quaternion {
  return new Quaternion().setFromEuler(new Euler(roll, pitch, yaw, "ZYX"));
}

/** Numbers with one of them replaced. */
export function withNumber<T extends readonly number[]>(numbers: T, index: number, value: number): T {
  return numbers.map((each, i) => (i === index ? value : each)) as unknown as T;
}
