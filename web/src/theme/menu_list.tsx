/** Floating lists of actions: below a button, or at a point; an entry can open a submenu. */

import type { JSX } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";

import { Icon, type IconName } from "./icons";

export interface MenuItem {
  readonly title: string;
  readonly keys?: string | undefined;
  readonly detail?: string;
  readonly icon?: IconName;
  /** Token of a color that stands before the title. */
  readonly color?: `--${string}`;
  readonly checked?: boolean;
  readonly disabled?: boolean;
  /** True: the menu stays open afterwards, as for a row of check marks. */
  readonly stays?: boolean;
  /** A line lies above it. */
  readonly starts?: boolean;
  /** Submenu that it opens instead of running. */
  readonly items?: () => readonly MenuItem[];
  readonly run?: () => void;
}

interface MenuProps {
  readonly items: readonly MenuItem[];
  readonly label?: string;
  /** Element on which a press does not close the menu. */
  readonly anchor?: HTMLElement;
  /** Positions the list. */
  readonly place: (list: HTMLElement) => void;
  readonly onClose: () => void;
}

/** Menu that closes by Escape, by a choice and by a press elsewhere. */
export function Menu({ items, label, anchor, place, onClose }: MenuProps): JSX.Element {
  const root = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const outside = ({ target }: PointerEvent): void => {
      if (target instanceof Node && root.current?.contains(target) !== true && anchor?.contains(target) !== true)
        onClose();
    };
    addEventListener("pointerdown", outside, true);
    return () => removeEventListener("pointerdown", outside, true);
  });
  return (
    <div ref={root} class="menus" onContextMenu={(event) => event.preventDefault()}>
      <List items={items} label={label} place={place} onClose={onClose} />
    </div>
  );
}

interface ListProps extends Pick<MenuProps, "items" | "place" | "onClose"> {
  readonly label: string | undefined;
  /** Goes back to the list from which it was opened. */
  readonly onBack?: () => void;
}

function List({ items, label, place, onClose, onBack }: ListProps): JSX.Element {
  const list = useRef<HTMLDivElement>(null);
  const [opened, setOpened] = useState<string | null>(null);
  const buttons = (): HTMLElement[] => [
    ...(list.current?.querySelectorAll<HTMLElement>("button:not(:disabled)") ?? []),
  ];
  useLayoutEffect(() => {
    if (list.current === null) return;
    place(list.current);
    buttons()[0]?.focus();
  }, []);
  const keyDown = (event: KeyboardEvent): void => {
    const at = buttons().indexOf(document.activeElement as HTMLElement);
    const steps: Readonly<Record<string, number>> = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: -1 };
    const to = steps[event.key];
    event.stopPropagation();
    if (event.key === "Escape" || event.key === "Tab") onClose();
    else if (event.key === "ArrowLeft" && onBack !== undefined) onBack();
    else if (to !== undefined)
      buttons()
        .at(to % buttons().length)
        ?.focus();
    else return;
    event.preventDefault();
  };
  const from = (title: string): HTMLElement | undefined =>
    buttons().find((button) => button.dataset["title"] === title);
  const inner = items.find(({ title }) => title === opened);
  const back = (): void => {
    if (opened !== null) from(opened)?.focus();
    setOpened(null);
  };
  return (
    <>
      <div ref={list} class="menu" role="menu" aria-label={label} onKeyDown={keyDown}>
        {items.map((item) => (
          <Entry
            key={item.title}
            item={item}
            isOpen={item.title === opened}
            onOpen={() => setOpened(item.items === undefined ? null : item.title)}
            onClose={onClose}
          />
        ))}
        {items.length === 0 && <div class="empty">Nothing here.</div>}
      </div>
      {inner?.items !== undefined && (
        <List
          key={inner.title}
          items={inner.items()}
          label={inner.title}
          place={(element) => placeBeside(element, from(inner.title))}
          onClose={onClose}
          onBack={back}
        />
      )}
    </>
  );
}

interface EntryProps {
  readonly item: MenuItem;
  readonly isOpen: boolean;
  /** Called when the pointer or the keyboard opens its submenu. */
  readonly onOpen: () => void;
  readonly onClose: () => void;
}

function Entry({ item, isOpen, onOpen, onClose }: EntryProps): JSX.Element {
  const opens = item.items !== undefined;
  const choose = (): void => {
    if (opens) {
      onOpen();
      return;
    }
    if (item.stays !== true) onClose();
    item.run?.();
  };
  return (
    <>
      {item.starts === true && <hr />}
      <button
        type="button"
        role={item.checked === undefined ? "menuitem" : item.stays === true ? "menuitemcheckbox" : "menuitemradio"}
        aria-checked={item.checked}
        aria-haspopup={opens ? "menu" : undefined}
        aria-expanded={opens ? isOpen : undefined}
        disabled={item.disabled}
        tabIndex={-1}
        data-title={item.title}
        onClick={choose}
        onPointerEnter={({ pointerType }) => pointerType === "mouse" && onOpen()}
        onKeyDown={({ key }) => key === "ArrowRight" && opens && onOpen()}
      >
        {item.icon !== undefined && <Icon name={item.icon} />}
        {item.stays === true && <Icon name="check" class={item.checked === true ? "" : "unchecked"} />}
        {item.color !== undefined && <span class="swatch" style={{ background: `var(${item.color})` }} />}
        {item.title}
        {item.detail !== undefined && <span class="r">{item.detail}</span>}
        {item.keys !== undefined && <kbd>{item.keys}</kbd>}
        {opens && <Icon name="right" class="r" />}
      </button>
    </>
  );
}

/** Put a floating element below its anchor, or above if there is no room below. */
export function placeBelow(element: HTMLElement, anchor: HTMLElement): void {
  const box = anchor.getBoundingClientRect();
  const { offsetHeight: height } = element;
  const below = box.bottom + 4 + height <= innerHeight || box.top < height + 4;
  put(element, box.left, below ? box.bottom + 4 : box.top - height - 4);
}

/** Put a floating element at a point of the page [px], or as near as the window allows. */
export function placeAt(element: HTMLElement, x: number, y: number): void {
  put(element, x, Math.max(4, Math.min(y, innerHeight - element.offsetHeight - 4)));
}

function placeBeside(element: HTMLElement, entry: HTMLElement | undefined): void {
  if (entry === undefined) return;
  const box = entry.getBoundingClientRect();
  const isRoom = box.right + element.offsetWidth + 4 <= innerWidth;
  placeAt(element, isRoom ? box.right : box.left - element.offsetWidth, box.top - 5);
}

function put(element: HTMLElement, x: number, y: number): void {
  element.style.left = `${Math.max(4, Math.min(x, innerWidth - element.offsetWidth - 4))}px`;
  element.style.top = `${y}px`;
}
