import { describe, expect, it } from "vitest";

import { sideWidths } from "../../src/app/layout";

describe("the side panels", () => {
  it("take at most 40 % of the window with their gaps", () => {
    expect(sideWidths(1440, 272, 280)).toEqual([272, 272]);
    expect(sideWidths(1920, 272, 280)).toEqual([272, 280]);
    expect(sideWidths(1280, 272, 280)).toEqual([240, 240]);
  });

  it("leave the right one a rail where there is no room for both", () => {
    expect(sideWidths(1279, 272, 280)).toEqual([272, 32]);
  });

  it("are rails where they are shut", () => {
    expect(sideWidths(1440, null, 280)).toEqual([32, 280]);
    expect(sideWidths(1000, 500, null)).toEqual([288, 32]);
  });
});
