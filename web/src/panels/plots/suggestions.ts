/** Suggested curves while nothing is plotted. */

import type { Page } from "../../page/page";
import { robotOf } from "../../page/world_nodes";

export interface Suggestion {
  readonly title: string;
  /** Paths for `PlotsState.add`. */
  readonly paths: readonly string[];
}

/** Suggestions: commanded and measured velocity of the robot, and its position. */
export function suggestions(page: Pick<Page, "connection" | "drive" | "world">): readonly Suggestion[] {
  const command = page.drive.topic.value;
  const isTwist = command !== null && page.connection.graph.value.types.get(command) === "geometry_msgs/Twist";
  const odometry = [...page.connection.topics.value.values()].find(({ type }) => type === "nav_msgs/Odometry")?.name;
  const robot = robotOf(page.world.manifest.value)?.name;
  return [
    ...(isTwist && odometry !== undefined
      ? [{ title: "Speed, commanded and measured", paths: [`${odometry}/twist/twist/linear/x`, `${command}/linear/x`] }]
      : []),
    ...(robot === undefined ? [] : [{ title: `Position of ${robot}`, paths: [`${robot}.pose.x`, `${robot}.pose.y`] }]),
  ];
}
