/** Menu of an interactive marker, at the pointer. */

import type { MenuEntry } from "../../protocol/generated/ros_messages";
import { MenuCommand } from "./control_modes";

/** Open a menu in the document; `choose` gets the entry that is clicked. It closes by itself. */
export function openMenu(
  entries: readonly MenuEntry[],
  x: number,
  y: number,
  choose: (entry: MenuEntry) => void,
): HTMLElement {
  const menu = document.createElement("div");
  menu.className = "menu";
  menu.setAttribute("role", "menu");
  const close = (): void => {
    menu.remove();
    document.removeEventListener("pointerdown", onOutside, true);
  };
  const onOutside = (event: Event): void => {
    if (!(event.target instanceof Node && menu.contains(event.target))) close();
  };
  addEntries(menu, entries, 0, 0, (entry) => {
    close();
    choose(entry);
  });
  menu.addEventListener("keydown", (event) => {
    if (event.key === "Escape") close();
    else if (event.key === "ArrowDown") step(menu, 1);
    else if (event.key === "ArrowUp") step(menu, -1);
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  document.addEventListener("pointerdown", onOutside, true);
  document.body.append(menu);
  menu.style.left = `${Math.max(0, Math.min(x, window.innerWidth - menu.offsetWidth))}px`;
  menu.style.top = `${Math.max(0, Math.min(y, window.innerHeight - menu.offsetHeight))}px`;
  step(menu, 1);
  return menu;
}

/** Entries of a parent, each followed by its indented children. */
function addEntries(
  menu: HTMLElement,
  entries: readonly MenuEntry[],
  parent: number,
  depth: number,
  choose: (entry: MenuEntry) => void,
): void {
  if (depth > 8) return; // a message's entries may be their own parents
  for (const entry of entries.filter((other) => other.parent_id === parent)) {
    const hasChildren = entries.some((other) => other.parent_id === entry.id);
    const item = document.createElement("button");
    item.type = "button";
    item.setAttribute("role", "menuitem");
    item.textContent = entry.title;
    item.style.paddingLeft = `${8 + 16 * depth}px`;
    item.disabled = hasChildren || entry.command_type !== MenuCommand.feedback;
    if (!hasChildren && item.disabled)
      item.title = `Runs "${entry.command}" on rviz's machine, which a page cannot do.`;
    item.addEventListener("click", () => choose(entry));
    menu.append(item);
    if (hasChildren) addEntries(menu, entries, entry.id, depth + 1, choose);
  }
}

function step(menu: HTMLElement, by: number): void {
  const items = [...menu.querySelectorAll<HTMLButtonElement>("button:not(:disabled)")];
  const at = items.findIndex((item) => item === document.activeElement);
  items[(at + by + items.length) % items.length]?.focus();
}
