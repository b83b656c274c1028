/** Rows that stay on one line: parts without room are hidden, lowest rank first, and appear in the row's menu. */

import type { ComponentChildren, JSX, RefObject } from "preact";
import { useLayoutEffect } from "preact/hooks";

import { MenuButton } from "./menu";
import type { MenuItem } from "./menu_list";

/** Entry of a row's menu, shown while the part of this name is hidden. */
export interface HiddenItem extends MenuItem {
  readonly part: string;
}

interface FittingPartProps {
  /** Parts of the lowest rank are hidden first. */
  readonly rank: number;
  /** Name of its entry in the row's menu; absent: it has none. */
  readonly part?: string;
  readonly children: ComponentChildren;
}

/** Part of a row that is hidden where there is no room. */
export function FittingPart({ rank, part, children }: FittingPartProps): JSX.Element {
  return (
    <span class="fits" data-rank={rank} data-part={part}>
      {children}
    </span>
  );
}

interface MoreProps {
  readonly row: RefObject<HTMLElement | null>;
  readonly label: string;
  readonly class?: string;
  readonly items: () => readonly HiddenItem[];
}

/** Menu of the hidden parts; it shows while there are any. */
export function More({ row, label, class: extra = "", items }: MoreProps): JSX.Element {
  const given = (): readonly MenuItem[] =>
    items().filter(({ part }) => row.current?.querySelector(`[data-given][data-part="${part}"]`) !== null);
  return <MenuButton class={`more ${extra}`} icon="dots" label={label} items={given} />;
}

/** Keep a row's content within its width, whenever it or one of its children changes its size. */
export function useFittingRow(row: RefObject<HTMLElement | null>): void {
  useLayoutEffect(() => {
    const element = row.current;
    if (element === null) return undefined;
    const { offsetParent: around } = element; // limits the row's width
    const sizes = new ResizeObserver((entries) => {
      const isRow = entries.some(({ target }) => target === element || target === around);
      if (isRow) fit(element);
      else requestAnimationFrame(() => fit(element)); // later: resizing siblings now would make the observer loop
    });
    const observe = (): void => {
      sizes.disconnect();
      for (const each of [element, ...element.children]) sizes.observe(each);
      if (around !== null) sizes.observe(around);
      fit(element);
    };
    const children = new MutationObserver(observe);
    children.observe(element, { childList: true });
    observe();
    return () => {
      sizes.disconnect();
      children.disconnect();
    };
  }, [row]);
}

function fit(row: HTMLElement): void {
  const parts = [...row.querySelectorAll<HTMLElement>("[data-rank]")];
  const ranks = [...new Set(parts.map(rankOf))].sort((a, b) => a - b);
  let limit = -1;
  const give = (): void => {
    for (const part of parts) part.toggleAttribute("data-given", rankOf(part) <= limit);
    row.toggleAttribute("data-gives", row.querySelector("[data-given][data-part]") !== null);
  };
  give();
  for (const rank of ranks) {
    if (!isTooNarrow(row)) return;
    limit = rank;
    give();
  }
}

function rankOf({ dataset }: HTMLElement): number {
  return Number(dataset["rank"]);
}

function isTooNarrow(row: HTMLElement): boolean {
  const end = Math.max(...[...row.children].map((child) => child.getBoundingClientRect().right));
  const { paddingRight, borderRightWidth } = getComputedStyle(row);
  return end > row.getBoundingClientRect().right - parseFloat(paddingRight) - parseFloat(borderRightWidth) + 0.5;
}
