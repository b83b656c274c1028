/** A list of any length: only the rows in view are drawn. */

import type { ComponentChildren, JSX } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";

interface VirtualRowsProps<T> {
  readonly label: string;
  readonly items: readonly T[];
  /** Height of every row [px]. */
  readonly height: number;
  /** Stay at the end while items come, unless a person scrolled up. */
  readonly follow: boolean;
  readonly row: (item: T, index: number) => ComponentChildren;
  readonly onKey?: (event: KeyboardEvent) => void;
}

const OVERSCAN = 4;

export function VirtualRows<T>({ label, items, height, follow, row, onKey }: VirtualRowsProps<T>): JSX.Element {
  const box = useRef<HTMLDivElement>(null);
  const isAtEnd = useRef(true);
  const [top, setTop] = useState(0);
  const [viewportHeight, setViewportHeight] = useState(0);
  useLayoutEffect(() => {
    const element = box.current;
    if (element === null) return;
    const observer = new ResizeObserver(() => setViewportHeight(element.clientHeight));
    observer.observe(element);
    return () => observer.disconnect();
  }, []);
  useLayoutEffect(() => {
    const element = box.current;
    if (element !== null && follow && isAtEnd.current) element.scrollTop = element.scrollHeight;
  }, [items, follow, viewportHeight]);
  const first = Math.max(0, Math.floor(top / height) - OVERSCAN);
  const last = Math.min(items.length, Math.ceil((top + viewportHeight) / height) + OVERSCAN);
  return (
    <div
      ref={box}
      class="scroll"
      role="log"
      aria-label={label}
      tabIndex={0}
      onScroll={({ currentTarget }) => {
        setTop(currentTarget.scrollTop);
        isAtEnd.current = currentTarget.scrollTop + currentTarget.clientHeight >= currentTarget.scrollHeight - height;
      }}
      onKeyDown={onKey}
    >
      <div style={{ height: `${items.length * height}px`, position: "relative" }}>
        <div style={{ position: "absolute", top: `${first * height}px`, left: 0, right: 0 }}>
          {items.slice(first, last).map((item, index) => row(item, first + index))}
        </div>
      </div>
    </div>
  );
}
