/** A row of tabs; arrows move between them. */

import type { JSX, TargetedKeyboardEvent } from "preact";

interface TabItem {
  readonly id: string;
  readonly title: string;
  /** Short form where the row is narrow. */
  readonly short?: string;
}

export interface TabsProps {
  readonly label: string;
  readonly items: readonly TabItem[];
  readonly selected: string;
  readonly onSelect: (id: string) => void;
}

export function Tabs({ label, items, selected, onSelect }: TabsProps): JSX.Element {
  const keyDown = (event: TargetedKeyboardEvent<HTMLDivElement>): void => {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (step === 0) return;
    const at = items.findIndex((item) => item.id === selected);
    const next = items.at((at + step) % items.length);
    if (next === undefined) return;
    event.preventDefault();
    onSelect(next.id);
    event.currentTarget.querySelector<HTMLElement>(`[data-tab="${next.id}"]`)?.focus();
  };
  return (
    <div role="tablist" aria-label={label} class="tablist" onKeyDown={keyDown}>
      {items.map(({ id, title, short }) => (
        <button
          key={id}
          type="button"
          class="tab"
          role="tab"
          data-tab={id}
          aria-label={short === undefined ? undefined : `${short}: ${title}`}
          aria-selected={id === selected}
          tabIndex={id === selected ? 0 : -1}
          onClick={() => onSelect(id)}
        >
          {short ?? title}
        </button>
      ))}
    </div>
  );
}
