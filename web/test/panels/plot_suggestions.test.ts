import { signal } from "@preact/signals";
import { describe, expect, it } from "vitest";

import type { Page } from "../../src/page/page";
import { suggestions } from "../../src/panels/plots/suggestions";
import { MANIFEST } from "../harness/manifest";

function page(topics: Readonly<Record<string, string>>, driven: string | null, isSimulated: boolean): Page {
  const infos = Object.entries(topics).map(([name, type]) => [name, { name, type }] as const);
  return {
    connection: { topics: signal(new Map(infos)), graph: signal({ types: new Map(Object.entries(topics)) }) },
    drive: { topic: signal(driven) },
    world: { manifest: signal(isSimulated ? MANIFEST : null) },
  } as unknown as Page;
}

describe("curves for an empty plot", () => {
  it("are velocities of a driven robot with odometry", () => {
    const topics = { "/r1/odom": "nav_msgs/Odometry", "/r1/cmd_vel": "geometry_msgs/Twist" };
    expect(suggestions(page(topics, "/r1/cmd_vel", false)).map(({ curves }) => curves)).toEqual([
      [
        ["/r1/odom/twist/twist/linear/x", "measured"],
        ["/r1/cmd_vel/linear/x", "commanded"],
      ],
    ]);
    expect(suggestions(page(topics, null, false))).toEqual([]);
  });

  it("are a simulated robot's position", () => {
    expect(suggestions(page({}, null, true))).toEqual([
      { title: "Position of rp2w", curves: [["rp2w.pose.x"], ["rp2w.pose.y"]] },
    ]);
  });
});
