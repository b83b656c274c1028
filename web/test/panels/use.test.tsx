// @vitest-environment jsdom
import { render, type JSX } from "preact";
import { useRef } from "preact/hooks";
import { act } from "preact/test-utils";
import { expect, test, vi } from "vitest";

import { useShown } from "../../src/panels/use";

function Watched(): JSX.Element {
  const root = useRef<HTMLDivElement>(null);
  return <div ref={root}>{useShown(root) ? "shown" : "hidden"}</div>;
}

test("of several observer entries at once, the newest is used", async () => {
  let tell: (entries: readonly { readonly isIntersecting: boolean }[]) => void = () => undefined;
  vi.stubGlobal(
    "IntersectionObserver",
    class {
      observe = vi.fn();
      disconnect = vi.fn();
      constructor(callback: typeof tell) {
        tell = callback;
      }
    },
  );
  const element = document.createElement("div");
  await act(() => render(<Watched />, element));
  await act(() => tell([{ isIntersecting: false }, { isIntersecting: true }]));
  expect(element.textContent).toBe("shown");
  await act(() => tell([{ isIntersecting: true }, { isIntersecting: false }]));
  expect(element.textContent).toBe("hidden");
  vi.unstubAllGlobals();
});
