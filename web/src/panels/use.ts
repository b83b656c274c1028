/** Hooks of the panels. */

import { useEffect, useState } from "preact/hooks";

/** Draw again every so many milliseconds while something can be seen. */
export function useTick(period: number, isShown = true): void {
  const [, setTick] = useState(0);
  useEffect(() => {
    if (!isShown) return;
    const timer = setInterval(() => setTick((count) => count + 1), period);
    return () => clearInterval(timer);
  }, [period, isShown]);
}

/** Text of a thrown value. */
export function sentence(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

/** Download a file. */
export function saveFile(name: string, content: Blob): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** Width of an element [px]; 0 before it is laid out. */
export function useWidth(element: { readonly current: Element | null }): number {
  const [width, setWidth] = useState(0);
  useEffect(() => {
    const { current } = element;
    if (current === null) return;
    const observer = new ResizeObserver(() => setWidth(current.clientWidth));
    observer.observe(current);
    return () => observer.disconnect();
  }, [element]);
  return width;
}

/** True while an element is visible, for example not in a background tab. */
export function useShown(element: { readonly current: Element | null }): boolean {
  const [isShown, setShown] = useState(false);
  useEffect(() => {
    const { current } = element;
    if (current === null) return;
    const observer = new IntersectionObserver((entries) => setShown(entries.at(-1)?.isIntersecting === true)); // the last entry is the newest
    observer.observe(current);
    return () => observer.disconnect();
  }, [element]);
  return isShown;
}
