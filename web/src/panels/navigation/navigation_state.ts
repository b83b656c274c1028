/** Client of the action move_base: sends the goals of the queue one after the other. */

import { computed, effect, signal, untracked } from "@preact/signals";

import type { Page } from "../../page/page";
import type { GoalState, QueuedGoal } from "../../page/goal_queue";
import type { Subscription } from "../../protocol/connection";
import type {
  GoalStatus,
  GoalStatusArray,
  MoveBaseActionFeedback,
  OccupancyGrid,
  PoseStamped,
  PoseWithCovarianceStamped,
  RecoveryStatus,
} from "../../protocol/generated/ros_messages";
import { timeOf } from "../../protocol/ros_types";
import { perPage } from "../per_page";
import { saveFile, sentence } from "../use";
import { mapFiles } from "./map_files";

const ACTION = "move_base_msgs/MoveBaseActionFeedback";
const FEEDBACK = "/feedback";
const POSE = "geometry_msgs/PoseWithCovarianceStamped";
const MAP = "nav_msgs/OccupancyGrid";
/**
 * Wall time after which a goal that no status lists counts as lost [ms]: actions list their goals five times a second.
 */
const UNKNOWN_AFTER = 5000;
const MAP_AFTER = 5000;

/** States of a goal by actionlib's numbers. */
const STATES: readonly GoalState[] = [
  "sent",
  "driving",
  "canceled",
  "reached",
  "failed",
  "failed",
  "driving",
  "sent",
  "canceled",
  "failed",
];

export class NavigationState {
  readonly servers = computed(() => this.topicsOf(ACTION).flatMap((name) => withoutEnd(name, FEEDBACK)));
  readonly chosen = signal<string | null>(null);
  /** Name of the action, as `/move_base`; null: there is none. */
  readonly server = computed(() => {
    const [first = null] = this.servers.value;
    return this.servers.value.find((name) => name === this.chosen.value) ?? first;
  });
  /** State of the newest goal of any sender. */
  readonly status = signal<GoalStatus | null>(null);
  readonly recovery = signal<RecoveryStatus | null>(null);
  /** Pose of the robot by localization. */
  readonly pose = signal<PoseWithCovarianceStamped | null>(null);
  /** Distance to the newest goal as the crow flies [m]; null: unknown. */
  readonly distance = computed(() => distanceBetween(this.base.value, this.target.value));
  readonly isRunning = signal(false);
  readonly fault = signal("");
  private readonly base = signal<PoseStamped | null>(null);
  private readonly target = signal<PoseStamped | null>(null);
  /** The queue's goal that was sent last. */
  private current: { readonly number: number; readonly id: string; namedAt: number } | null = null;

  constructor(private readonly page: Page) {
    effect(() => {
      const server = this.server.value;
      const subscriptions = server === null ? [] : untracked(() => this.follow(server));
      return () => close(subscriptions);
    });
    effect(() => {
      const topic = this.poseTopic();
      if (topic === null) return undefined;
      const { connection } = this.page;
      const subscription = connection.subscribe<PoseWithCovarianceStamped>(
        topic,
        ({ message }) => void (this.pose.value = message),
      );
      return () => subscription.close();
    });
  }

  get queue(): Page["goals"] {
    return this.page.goals;
  }

  /** Send the first waiting goal, and each next goal once the previous one has ended. */
  start(): void {
    const next = this.queue.goals.peek().find(({ state }) => state === "waiting");
    this.isRunning.value = next !== undefined;
    if (next !== undefined) this.send(next);
  }

  /** Cancel the goal that the robot drives to, of any sender; the queue's other goals keep waiting. */
  stop(): void {
    const server = this.server.peek();
    this.isRunning.value = false;
    if (server === null) return;
    this.page.connection.publish(`${server}/cancel`, "actionlib_msgs/GoalID", { stamp: timeOf(0n), id: "" });
  }

  get clearService(): string | null {
    const name = `${this.server.value ?? ""}/clear_costmaps`;
    return this.page.connection.services.value.has(name) ? name : null;
  }

  clearCostmaps(): void {
    const { clearService } = this;
    if (clearService === null) return;
    this.page.connection.callService(clearService, {}).then(
      () => void (this.fault.value = ""),
      (error: unknown) => void (this.fault.value = sentence(error)),
    );
  }

  /** Topic of the map, which is not a costmap's; null: there is none. */
  get mapTopic(): string | null {
    const names = this.topicsOf(MAP).filter((name) => !name.includes("costmap"));
    return names.find((name) => name === "/map") ?? names[0] ?? null;
  }

  /** Download the map as NAME.pgm and NAME.yaml. */
  saveMap(): void {
    const topic = this.mapTopic;
    if (topic === null) return;
    const timer = setTimeout(() => {
      subscription.close();
      this.fault.value = `No map has come on ${topic} within 5 s.`;
    }, MAP_AFTER);
    const subscription = this.page.connection.subscribe<OccupancyGrid>(topic, ({ message }) => {
      clearTimeout(timer);
      queueMicrotask(() => subscription.close()); // later: the first message may come before it is defined
      const name = topic.slice(topic.lastIndexOf("/") + 1);
      const files = mapFiles(name, message);
      this.fault.value = typeof files === "string" ? `${topic}: ${files}` : "";
      if (typeof files === "string") return;
      saveFile(`${name}.pgm`, files.pgm);
      saveFile(`${name}.yaml`, files.yaml);
    });
  }

  private topicsOf(type: string): readonly string[] {
    const topics = [...this.page.connection.topics.value.values()];
    return topics
      .filter((topic) => topic.type === type)
      .map(({ name }) => name)
      .sort();
  }

  /** Topic of the localization pose whose namespace is nearest to the action's. */
  private poseTopic(): string | null {
    const names = this.topicsOf(POSE).filter((name) => name.endsWith("amcl_pose") || name.endsWith("poseupdate"));
    const server = this.server.value ?? "";
    const namespace = server.slice(0, server.lastIndexOf("/") + 1);
    return names.find((name) => name.startsWith(namespace)) ?? null;
  }

  private follow(server: string): readonly Subscription[] {
    const { connection } = this.page;
    this.status.value = this.recovery.value = this.base.value = this.target.value = null;
    return [
      connection.subscribe<GoalStatusArray>(`${server}/status`, ({ message }) => this.onStatus(message)),
      connection.subscribe<MoveBaseActionFeedback>(
        `${server}${FEEDBACK}`,
        ({ message }) => void (this.base.value = message.feedback.base_position),
      ),
      connection.subscribe<PoseStamped>(`${server}/current_goal`, ({ message }) => {
        this.target.value = message;
        this.recovery.value = null;
      }),
      connection.subscribe<RecoveryStatus>(
        `${server}/recovery_status`,
        ({ message }) => void (this.recovery.value = message),
      ),
    ];
  }

  private send(goal: QueuedGoal): void {
    const server = this.server.peek();
    if (server === null) return;
    const { connection, session } = this.page;
    const stamp = timeOf(connection.now());
    const random = Math.random().toString(36).slice(2); // unique: two pages may send goals
    const id = `${session.node ?? "page"}-${goal.number}-${random}`;
    const header = { seq: 0, stamp, frame_id: goal.frame };
    this.current = { number: goal.number, id, namedAt: performance.now() };
    this.queue.mark(goal.number, "sent");
    connection.publish(`${server}/goal`, "move_base_msgs/MoveBaseActionGoal", {
      header,
      goal_id: { stamp, id },
      goal: { target_pose: { header, pose: goal.pose } },
    });
  }

  private onStatus({ status_list: all }: GoalStatusArray): void {
    const last = this.status.peek(); // kept, since a node forgets its goals after some seconds
    this.status.value = all.reduce((newest, one) => (isNewer(one, newest) ? one : newest), last);
    const { current } = this;
    if (current === null) return;
    const status = all.find(({ goal_id }) => goal_id.id === current.id);
    if (status !== undefined) {
      current.namedAt = performance.now();
      this.onState(current.number, STATES[status.status] ?? "failed", status.text);
    } else if (performance.now() - current.namedAt > UNKNOWN_AFTER)
      this.onState(current.number, "failed", "the node no longer knows this goal");
  }

  private onState(number: number, state: GoalState, text: string): void {
    this.queue.mark(number, state, state === "failed" ? text : "");
    if (state === "sent" || state === "driving") return;
    this.current = null;
    if (state === "reached" && this.isRunning.peek()) this.start();
    else this.isRunning.value = false;
  }
}

export const navigationState = perPage((page) => new NavigationState(page));

function close(subscriptions: readonly Subscription[]): void {
  for (const subscription of subscriptions) subscription.close();
}

function withoutEnd(name: string, end: string): readonly string[] {
  return name.endsWith(end) ? [name.slice(0, -end.length)] : [];
}

function isNewer({ goal_id: { stamp } }: GoalStatus, other: GoalStatus | null): boolean {
  if (other === null) return true;
  const { sec, nsec } = other.goal_id.stamp;
  return stamp.sec > sec || (stamp.sec === sec && stamp.nsec >= nsec);
}

function distanceBetween(a: PoseStamped | null, b: PoseStamped | null): number | null {
  if (a === null || b === null || a.header.frame_id !== b.header.frame_id) return null;
  const [from, to] = [a.pose.position, b.pose.position];
  return Math.hypot(to.x - from.x, to.y - from.y);
}
