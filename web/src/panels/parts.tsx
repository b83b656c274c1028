/** Components that several panels use. */

import type { Signal } from "@preact/signals";
import type { ComponentChildren, JSX, RefObject } from "preact";

import { Button } from "../theme/button";
import { Icon } from "../theme/icons";

interface SplitProps {
  /** A row above the list. */
  readonly head?: ComponentChildren;
  /** Shown beside the list, or below it where the panel is narrow; false: the list alone. */
  readonly detail: ComponentChildren;
  readonly children: ComponentChildren;
  readonly root?: RefObject<HTMLDivElement | null>;
}

/** List with the details of its selected item. */
export function Split({ head, detail, children, root }: SplitProps): JSX.Element {
  return (
    <div class="split" ref={root ?? null}>
      <div class="main">
        {head}
        <div class="scroll">{children}</div>
      </div>
      {detail !== false && detail !== null && <div class="detail">{detail}</div>}
    </div>
  );
}

/** A field that filters while one types. */
export function FilterField({ label, value }: { readonly label: string; readonly value: Signal<string> }): JSX.Element {
  return (
    <div class="filterrow">
      <span class="field small">
        <Icon name="find" />
        <input
          type="search"
          aria-label={label}
          placeholder={label}
          value={value.value}
          spellcheck={false}
          autocomplete="off"
          onInput={(event) => void (value.value = event.currentTarget.value)}
        />
      </span>
    </div>
  );
}

/** Shows and hides a filter; hiding it ends the filtering. */
export function FilterButton({
  on,
  text,
}: {
  readonly on: Signal<boolean>;
  readonly text: Signal<string>;
}): JSX.Element {
  const toggle = (): void => {
    on.value = !on.value;
    if (!on.value) text.value = "";
  };
  return (
    <Button small icon="filter" on={on.value} onClick={toggle}>
      Filter
    </Button>
  );
}
