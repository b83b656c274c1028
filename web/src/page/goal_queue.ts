/** Goals of navigation in the order in which the robot drives to them. */

import { signal } from "@preact/signals";

import type { Pose } from "../protocol/generated/ros_messages";

export type GoalState = "waiting" | "sent" | "driving" | "reached" | "failed" | "canceled";

/** Pose in a frame. */
export interface GoalPose {
  readonly frame: string;
  readonly pose: Pose;
}

export interface QueuedGoal extends GoalPose {
  /** Number in the scene and in the list, from 1. */
  readonly number: number;
  readonly state: GoalState;
  /** Reason of a failure, as the node gives it. */
  readonly reason: string;
}

export class GoalQueue {
  /** True: the tool 2D Nav Goal adds goals here instead of sending them. */
  readonly collects = signal(false);
  readonly goals = signal<readonly QueuedGoal[]>([]);

  add(goal: GoalPose): void {
    const goals = this.goals.peek();
    this.goals.value = [...goals, { ...goal, number: (goals.at(-1)?.number ?? 0) + 1, state: "waiting", reason: "" }];
  }

  remove(number: number): void {
    this.goals.value = this.goals.peek().filter((goal) => goal.number !== number);
  }

  clear(): void {
    this.goals.value = [];
  }

  mark(number: number, state: GoalState, reason = ""): void {
    const goals = this.goals.peek();
    if (goals.some((goal) => goal.number === number && (goal.state !== state || goal.reason !== reason)))
      this.goals.value = goals.map((goal) => (goal.number === number ? { ...goal, state, reason } : goal));
  }
}
