/** Client of a ROS action: sends goals, one at a time, and waits for their results. */

import type { Connection, Subscription } from "../../protocol/connection";
import type { GoalStatusArray } from "../../protocol/generated/ros_messages";
import { timeOf, type RosMessage } from "../../protocol/ros_types";

/** Wall time after which a goal that no status lists counts as lost [ms]: actions list their goals five times a second. */
const UNKNOWN_AFTER = 5000;

interface ActionResult {
  readonly status: { readonly goal_id: { readonly id: string }; readonly text: string };
  readonly result: RosMessage;
}

interface Pending {
  readonly id: string;
  namedAt: number;
  readonly resolve: (result: RosMessage) => void;
  readonly reject: (reason: Error) => void;
}

export class ActionClient {
  private readonly subscriptions: readonly Subscription[];
  private pending: Pending | null = null;
  private count = 0;

  constructor(
    private readonly connection: Connection,
    /** Name of the action, as `/move_group`. */
    readonly name: string,
    /** Type of its goals, as `moveit_msgs/MoveGroupActionGoal`. */
    private readonly type: string,
  ) {
    this.subscriptions = [
      connection.subscribe<ActionResult>(`${name}/result`, ({ message }) => this.onResult(message), { every: true }),
      connection.subscribe<GoalStatusArray>(`${name}/status`, ({ message }) => this.onStatus(message)),
    ];
  }

  /** Send a goal; the promise holds its result, or rejects with a sentence. */
  send(goal: RosMessage): Promise<RosMessage> {
    this.pending?.reject(new Error("Another goal took its place."));
    const stamp = timeOf(this.connection.now());
    this.count += 1;
    const id = `trundle_page-${this.count}-${Math.random().toString(36).slice(2)}`; // unique: two pages may send goals
    const header = { seq: 0, stamp, frame_id: "" };
    return new Promise((resolve, reject) => {
      this.pending = { id, namedAt: performance.now(), resolve, reject };
      this.connection.publish(`${this.name}/goal`, this.type, { header, goal_id: { stamp, id }, goal });
    });
  }

  /** Cancel the goal that was sent last. */
  cancel(): void {
    if (this.pending === null) return;
    this.connection.publish(`${this.name}/cancel`, "actionlib_msgs/GoalID", { stamp: timeOf(0n), id: this.pending.id });
  }

  close(): void {
    for (const subscription of this.subscriptions) subscription.close();
    this.pending?.reject(new Error(`${this.name} is gone.`));
    this.pending = null;
  }

  private onResult({ status, result }: ActionResult): void {
    const { pending } = this;
    if (pending?.id !== status.goal_id.id) return;
    this.pending = null;
    pending.resolve(result);
  }

  private onStatus({ status_list: all }: GoalStatusArray): void {
    const { pending } = this;
    if (pending === null) return;
    if (all.some(({ goal_id }) => goal_id.id === pending.id)) pending.namedAt = performance.now();
    else if (performance.now() - pending.namedAt > UNKNOWN_AFTER) {
      this.pending = null;
      pending.reject(new Error(`${this.name} no longer knows this goal.`));
    }
  }
}
