import { describe, expect, it } from "vitest";

import { sideWidths } from "../../src/app/layout";

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
