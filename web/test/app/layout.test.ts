// @vitest-environment jsdom
/** Widths of the side panels, and the height of the dock. */

import { beforeEach, describe, expect, it } from "vitest";

import { Layout, sideWidths } from "../../src/app/layout";

describe("the side panels", () => {
  it("cover at most 40 % of the window, with their gaps", () => {
    expect(sideWidths(1440, 272, 280)).toEqual([272, 272]);
    expect(sideWidths(1920, 272, 280)).toEqual([272, 280]);
    expect(sideWidths(1280, 272, 280)).toEqual([240, 240]);
  });

  it("collapse the right one to a rail if there is no room for both", () => {
    expect(sideWidths(1279, 272, 280)).toEqual([272, 32]);
  });

  it("are rails while closed", () => {
    expect(sideWidths(1440, null, 280)).toEqual([32, 280]);
    expect(sideWidths(1000, 500, null)).toEqual([288, 32]);
  });
});

describe("the dock", () => {
  beforeEach(() => {
    localStorage.clear();
    Object.assign(window, { innerWidth: 1440, innerHeight: 900 });
  });

  const opened = (height: number): Layout => {
    const layout = new Layout("simulation");
    layout.height.value = height;
    layout.dockBegins.value = true;
    return layout;
  };

  it("begins closed until there is something to show, and then is as a person leaves it", () => {
    const layout = new Layout("simulation");
    expect(layout.dock.value).toBe(32);
    layout.dockBegins.value = true;
    expect(layout.dock.value).toBe(200);
    layout.openDock(false);
    expect(opened(900).dock.value).toBe(32);
  });

  it("takes less of a low window, unless a person has chosen its height", () => {
    expect([900, 800, 700, 600].map((height) => opened(height).dock.value)).toEqual([200, 170, 140, 120]);
    opened(900).resizeDock(240);
    expect([900, 700].map((height) => opened(height).dock.value)).toEqual([240, 240]);
  });

  it("is as high as its contents, up to a third of the window or what a person has chosen", () => {
    const layout = opened(900);
    layout.dockContents.value = 166;
    expect(layout.dock.value).toBe(166);
    layout.dockContents.value = 2000;
    expect(layout.dock.value).toBe(300);
    layout.resizeDock(240);
    expect(layout.dock.value).toBe(240);
  });
});
