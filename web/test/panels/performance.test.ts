import { expect, test } from "vitest";

import type { Profile } from "../../src/protocol/generated/page_messages";
import { barOf, rowsOf, sparkline } from "../../src/panels/performance/performance_state";

const PROFILE: Profile = {
  wall_s: 2,
  simulated_s: 0.5,
  steps: 500,
  contacts: 4,
  bodies: 2,
  asleep: 0,
  graph_s: null,
  parts: [
    { group: "waiting", name: "Waiting", wall_s: 1.2 },
    { group: "page", name: "Page", wall_s: 0.1 },
    { group: "physics", name: "Dynamics", wall_s: 0.4 },
    { group: "cameras", name: "m::l::cam", wall_s: 0.3 },
  ],
};

test("rows show the wall time per simulated second, waiting last", () => {
  expect(rowsOf(PROFILE).map(({ name, perSecond, share }) => [name, perSecond, share])).toEqual([
    ["Dynamics", 800, 0.2],
    ["m::l::cam", 600, 0.15],
    ["Page", 200, 0.05],
    ["Waiting", 2400, 0.6],
  ]);
  expect(rowsOf({ ...PROFILE, simulated_s: 0 })).toEqual([]);
});

test("the bar goes group by group", () => {
  expect(barOf(rowsOf(PROFILE)).map(({ group }) => group)).toEqual(["physics", "cameras", "page", "waiting"]);
});

test("a line of factors has its top at 1 or at the maximum", () => {
  expect(sparkline([0, 0.5, 1])).toBe("0.0,19.0 50.0,10.0 100.0,1.0");
  expect(sparkline([0, 2])).toBe("0.0,19.0 100.0,1.0");
});
