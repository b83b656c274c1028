/** Curves that are worth a look where nothing is plotted yet. */

import type { Page } from "../../page/page";
import { robotOf } from "../../page/world_nodes";

export interface Suggestion {
  readonly title: string;
  /** As `PlotsState.add` takes them. */
  readonly paths: readonly string[];
}

/** The speed that is asked of a robot beside what it does, and where it is. */
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
