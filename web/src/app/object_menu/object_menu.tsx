/** Menu of an object in the scene or tree, opened by the right button, a long press, or the keyboard's menu key. */

import type { JSX } from "preact";
import type { Vector3 } from "three";

import { Menu, placeAt } from "../../theme/menu_list";
import { selectionOf } from "../../tools/picked";
import type { Selection } from "../../page/page";
import type { Shell } from "../shell";
import { objectItems } from "./object_items";

export function ObjectMenu({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const open = shell.menu.value;
  if (open === null) return null;
  const items = objectItems(shell, open.selection, open.at);
  if (items.length === 0) return null;
  const close = (): void => {
    shell.menu.value = null;
    if (open.from instanceof HTMLElement) open.from.focus();
  };
  return (
    <Menu
      key={`${open.x} ${open.y}`}
      items={items}
      label="Selection"
      place={(list) => placeAt(list, open.x, open.y)}
      onClose={close}
    />
  );
}

/** Select an object, and open its menu at a point of the page [px]. */
export function openMenu(
  shell: Shell,
  selection: Selection | null,
  x: number,
  y: number,
  at: Vector3 | null = null,
): void {
  if (objectItems(shell, selection, at).length === 0) return;
  if (selection !== null) shell.select(selection);
  shell.menu.value = { selection, x, y, at, from: document.activeElement };
}

/** Open the menu of the object under a point of the scene [px]. */
export function openSceneMenu(shell: Shell, x: number, y: number): void {
  const { scene } = shell.page;
  const pick = scene.pick(x, y);
  const point = pick?.point ?? scene.pickGround(x, y);
  scene.world.updateWorldMatrix(true, false);
  const { left, top } = scene.element.getBoundingClientRect();
  openMenu(
    shell,
    selectionOf(pick),
    left + x,
    top + y,
    point === null ? null : scene.world.worldToLocal(point.clone()),
  );
}

/** Open the menu of the selection, in the middle of the scene. */
export function openSelectedMenu(shell: Shell): void {
  const { scene, selection } = shell.page;
  const { left, top } = scene.element.getBoundingClientRect();
  const free = scene.freePart.peek();
  openMenu(shell, selection.peek(), left + free.left + free.width / 2, top + free.top + free.height / 2);
}
