/** Buttons. */

import type { ComponentChildren, JSX, TargetedMouseEvent } from "preact";

import { Icon, type IconName } from "./icons";

export interface ButtonProps {
  readonly icon?: IconName;
  /** Name for screen readers and the tooltip; required without text. */
  readonly label?: string;
  /** Shown in the tooltip beside the name. */
  readonly keys?: string | undefined;
  readonly tone?: "plain" | "line" | "primary";
  readonly small?: boolean;
  /** State of a toggle button. */
  readonly on?: boolean;
  readonly disabled?: boolean;
  readonly class?: string;
  readonly onClick: (event: TargetedMouseEvent<HTMLButtonElement>) => void;
  readonly children?: ComponentChildren;
}

export function Button(props: ButtonProps): JSX.Element {
  const { icon, label, keys, tone = "plain", small, on, disabled, class: extra = "", onClick, children } = props;
  const classes = ["b", extra];
  if (children === undefined) classes.push("ic");
  if (tone !== "plain") classes.push(tone === "primary" ? "pri" : "line");
  if (small === true) classes.push("sml");
  if (on === true) classes.push("on");
  return (
    <button
      type="button"
      class={classes.filter((name) => name !== "").join(" ")}
      aria-label={label}
      aria-pressed={on}
      data-tip={label === undefined ? undefined : keys === undefined ? label : `${label} (${keys})`}
      disabled={disabled}
      onClick={onClick}
    >
      {icon !== undefined && <Icon name={icon} />}
      {children}
    </button>
  );
}
