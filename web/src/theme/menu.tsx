/** A button that opens a list of actions below it. */

import type { ComponentChildren, JSX } from "preact";
import { useRef, useState } from "preact/hooks";

import { Icon, type IconName } from "./icons";
import { Menu, placeBelow, type MenuItem } from "./menu_list";

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
  const { current: anchor } = button;
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
      {open && anchor !== null && (
        <Menu items={items()} anchor={anchor} place={(list) => placeBelow(list, anchor)} onClose={close} />
      )}
    </>
  );
}
