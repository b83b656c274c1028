/** A list of actions that opens below its button. */

import type { ComponentChildren, JSX } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";

import { Icon, type IconName } from "./icons";

export interface MenuItem {
  readonly title: string;
  readonly keys?: string | undefined;
  readonly detail?: string;
  readonly icon?: IconName;
  /** Token of a colour that stands before the title. */
  readonly colour?: `--${string}`;
  readonly checked?: boolean;
  readonly disabled?: boolean;
  /** The menu stays open after it, as for a row of check marks. */
  readonly stays?: boolean;
  readonly run: () => void;
}

export interface MenuButtonProps {
  readonly label?: string;
  readonly icon?: IconName;
  readonly class?: string;
  readonly items: () => readonly MenuItem[];
  readonly children?: ComponentChildren;
}

/** A button with a menu. */
export function MenuButton({ label, icon, class: extra = "", items, children }: MenuButtonProps): JSX.Element {
  const [open, setOpen] = useState(false);
  const button = useRef<HTMLButtonElement>(null);
  const close = (): void => {
    setOpen(false);
    button.current?.focus();
  };
  return (
    <>
      <button
        ref={button}
        type="button"
        class={`b ${children === undefined ? "ic" : ""} ${extra}`}
        aria-label={label}
        data-tip={open ? undefined : label}
        aria-haspopup="menu"
        aria-expanded={open}
        onClick={() => setOpen(!open)}
      >
        {icon !== undefined && <Icon name={icon} />}
        {children}
        {children !== undefined && <Icon name="down" class="chev" />}
      </button>
      {open && button.current !== null && <Menu items={items()} anchor={button.current} onClose={close} />}
    </>
  );
}

interface MenuProps {
  readonly items: readonly MenuItem[];
  readonly anchor: HTMLElement;
  readonly onClose: () => void;
}

function Menu({ items, anchor, onClose }: MenuProps): JSX.Element {
  const list = useRef<HTMLDivElement>(null);
  useLayoutEffect(() => {
    if (list.current === null) return;
    place(list.current, anchor);
    list.current.querySelector<HTMLElement>("button:not(:disabled)")?.focus();
  }, [anchor]);
  useEffect(() => {
    const outside = (event: PointerEvent): void => {
      if (event.target instanceof Node && !list.current?.contains(event.target) && !anchor.contains(event.target)) onClose();
    };
    addEventListener("pointerdown", outside, true);
    return () => removeEventListener("pointerdown", outside, true);
  });
  const keyDown = (event: KeyboardEvent): void => {
    const buttons = [...(list.current?.querySelectorAll<HTMLElement>("button:not(:disabled)") ?? [])];
    const at = buttons.indexOf(document.activeElement as HTMLElement);
    const steps: Readonly<Record<string, number>> = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: -1 };
    const to = steps[event.key];
    event.stopPropagation();
    if (event.key === "Escape" || event.key === "Tab") onClose();
    else if (to !== undefined) buttons.at(to % buttons.length)?.focus();
    else return;
    event.preventDefault();
  };
  return (
    <div ref={list} class="menu" role="menu" onKeyDown={keyDown}>
      {items.map((item) => (
        <button
          key={item.title}
          type="button"
          role={item.checked === undefined ? "menuitem" : item.stays === true ? "menuitemcheckbox" : "menuitemradio"}
          aria-checked={item.checked}
          disabled={item.disabled}
          tabIndex={-1}
          onClick={() => {
            if (item.stays !== true) onClose();
            item.run();
          }}
        >
          {item.icon !== undefined && <Icon name={item.icon} />}
          {item.stays === true && <Icon name="check" class={item.checked === true ? "" : "unchecked"} />}
          {item.colour !== undefined && <span class="swatch" style={{ background: `var(${item.colour})` }} />}
          {item.title}
          {item.detail !== undefined && <span class="r">{item.detail}</span>}
          {item.keys !== undefined && <kbd>{item.keys}</kbd>}
        </button>
      ))}
      {items.length === 0 && <div class="empty">Nothing here.</div>}
    </div>
  );
}

/** Put a floating element below its anchor, or above where there is no room below. */
export function place(element: HTMLElement, anchor: HTMLElement): void {
  const box = anchor.getBoundingClientRect();
  const { offsetWidth: width, offsetHeight: height } = element;
  const below = box.bottom + 4 + height <= innerHeight || box.top < height + 4;
  element.style.left = `${Math.max(4, Math.min(box.left, innerWidth - width - 4))}px`;
  element.style.top = `${below ? box.bottom + 4 : box.top - height - 4}px`;
}
