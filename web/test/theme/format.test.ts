import { describe, expect, it } from "vitest";

import { clock, fixed, parseNumber, plain, rosTime } from "../../src/theme/format";
import { numberFault } from "../../src/theme/number_field";

describe("numbers", () => {
  it("have fixed decimals, a true minus sign and no negative zero", () => {
    expect([fixed(-0.0041, 3), fixed(-0.0001, 3), fixed(null, 2), fixed(1 / 0, 2)]).toEqual([
      "−0.004",
      "0.000",
      "—",
      "—",
    ]);
    expect([plain(0.1 + 0.2), plain(-2)]).toEqual(["0.3", "−2"]);
  });

  it("are read back as they are written", () => {
    expect([parseNumber("−0.5"), parseNumber("0,5"), parseNumber(" "), parseNumber("x")]).toEqual([
      -0.5,
      0.5,
      null,
      null,
    ]);
  });

  it("are refused with a sentence", () => {
    expect(numberFault("two", {})).toBe('"two" is not a number.');
    expect(numberFault("2", { max: 1 })).toBe("At most 1.");
    expect(numberFault("1.5", { integer: true })).toBe("Enter a whole number.");
    expect(numberFault("1", { min: 0, max: 1 })).toBeNull();
  });
});

describe("times", () => {
  it("are minutes and seconds, with hours if nonzero", () => {
    expect([clock(12.48), clock(221.06), clock(12, 0), clock(3723.5), clock(-1.5, 1)]).toEqual([
      "0:12.48",
      "3:41.06",
      "0:12",
      "1:02:03.50",
      "−0:01.5",
    ]);
  });

  it("of ROS are as simulated, or the time of day", () => {
    expect(rosTime(221_060_000_000n)).toBe("3:41.06");
    expect(rosTime(1_700_000_000_000_000_000n)).toMatch(/^\d{1,2}:\d\d:\d\d$|^\d{1,2}:\d\d$/);
  });
});
