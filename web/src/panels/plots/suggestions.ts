/** Suggested curves while nothing is plotted. */

import type { Page } from "../../page/page";
import { robotOf } from "../../page/world_nodes";

export interface Suggestion {
  readonly title: string;
  /** Paths for `PlotsState.add`, and names of their curves. */
  readonly curves: readonly (readonly [path: string, name?: string])[];
}

/** Commanded and measured speed; null: nothing is commanded and measured. */
export function speedOf({ connection, drive }: Pick<Page, "connection" | "drive">): Suggestion | null {
  const command = drive.topic.value;
  const isTwist = command !== null && connection.graph.value.types.get(command) === "geometry_msgs/Twist";
  const odometry = [...connection.topics.value.values()].find(({ type }) => type === "nav_msgs/Odometry")?.name;
  if (!isTwist || odometry === undefined) return null;
  return {
    title: "Speed, commanded and measured",
    curves: [
      [`${odometry}/twist/twist/linear/x`, "measured"],
      [`${command}/linear/x`, "commanded"],
    ],
  };
}

/** Suggestions: commanded and measured velocity of the robot, and its position. */
export function suggestions(page: Pick<Page, "connection" | "drive" | "world">): readonly Suggestion[] {
  const speed = speedOf(page);
  const robot = robotOf(page.world.manifest.value)?.name;
  return [
    ...(speed === null ? [] : [speed]),
    ...(robot === undefined
      ? []
      : [{ title: `Position of ${robot}`, curves: [[`${robot}.pose.x`], [`${robot}.pose.y`]] as const }]),
  ];
}
