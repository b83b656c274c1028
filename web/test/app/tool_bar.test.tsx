// @vitest-environment jsdom
import { signal } from "@preact/signals";
import { render } from "preact";
import { act } from "preact/test-utils";
import { afterEach, beforeEach, expect, it, vi } from "vitest";

import { Shell } from "../../src/app/shell";
import { ToolBar } from "../../src/app/tool_bar";
import { fakePage, type FakePage } from "../fake_page";

beforeEach(() => {
  localStorage.clear();
  vi.stubGlobal(
    "ResizeObserver",
    class {
      observe(): void {
        // nothing has a size
      }
      disconnect(): void {
        // nor ever
      }
    },
  );
});

afterEach(() => vi.unstubAllGlobals());

function shownTools(page: FakePage): string[] {
  const host = document.createElement("div");
  const shell = new Shell(page, page.commands, document.createElement("div"), signal(false));
  void act(() => render(<ToolBar shell={shell} />, host));
  return [...host.querySelectorAll("[data-part] button")].map((button) => button.getAttribute("aria-label") ?? "");
}

it("offers a tool of navigation where a node other than the page subscribes to its topic", () => {
  const page = fakePage({ kind: "graph" });
  const subscribe = (...nodes: string[]): void => {
    page.connection.graph.value = { ...page.connection.graph.value, subscribers: new Map([["/goal", nodes]]) };
  };
  expect(shownTools(page)).not.toContain("2D Nav Goal");
  subscribe("/trundle_page_1");
  expect(shownTools(page)).not.toContain("2D Nav Goal");
  subscribe("/trundle_page_1", "/move_base");
  expect(shownTools(page)).toContain("2D Nav Goal");
});
