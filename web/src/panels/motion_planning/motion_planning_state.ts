/** Client of move_group: plans, executes and stops, for the display MotionPlanning. */

import { computed, effect, signal, untracked } from "@preact/signals";

import { withMembers } from "../../displays/group";
import { MotionPlanningDisplay } from "../../displays/motion_planning";
import { SUCCESS, words } from "../../displays/moveit/error_codes";
import { slowed } from "../../displays/moveit/trajectory";
import { moveGroupNamespaces } from "../../page/arms";
import type { Page } from "../../page/page";
import type { PlannerInterfaceDescription, RobotTrajectory } from "../../protocol/generated/ros_messages";
import { seconds, type RosMessage } from "../../protocol/ros_types";
import { count, fixed } from "../../theme/format";
import { perPage } from "../per_page";
import { sentence } from "../use";
import { ActionClient } from "./action_client";
import { cartesianRequest, moveGroupGoal, type Planner } from "./plan_request";

export interface Outcome {
  readonly isDone: boolean;
  readonly text: string;
}

type Task = "Planning" | "Executing" | "Planning and executing";

export class MotionPlanningState {
  readonly namespaces = computed(() => moveGroupNamespaces(this.page.connection));
  /** The first enabled display MotionPlanning; null: there is none. */
  readonly display = computed((): MotionPlanningDisplay | null => {
    const all = withMembers(this.page.displays.displays.value, ({ enabled }) => enabled.value.value);
    return all.find((one): one is MotionPlanningDisplay => one instanceof MotionPlanningDisplay) ?? null;
  });
  /** Namespace of the display's move_group, or of the first one; null: there is none. */
  readonly namespace = computed((): string | null => {
    const { value: all } = this.namespaces;
    const own = this.display.value?.moveGroupName("move_group").slice(0, -"/move_group".length);
    return all.find((name) => name === own) ?? all[0] ?? null;
  });
  readonly task = signal<Task | null>(null);
  readonly outcome = signal<Outcome | null>(null);
  /** The path that Execute follows; null: none is planned. */
  readonly planned = signal<RobotTrajectory | null>(null);
  readonly planners = signal<readonly PlannerInterfaceDescription[]>([]);
  readonly pipeline = signal("");
  readonly planner = signal("");
  private planning: ActionClient | null = null;
  private execution: ActionClient | null = null;

  constructor(readonly page: Page) {
    effect(() => {
      const namespace = this.namespace.value;
      if (namespace === null) return undefined;
      return untracked(() => this.connect(namespace));
    });
    effect(() => {
      const name = this.serviceName("query_planner_interface");
      const isThere = this.page.connection.services.value.has(name);
      untracked(() => isThere && void this.askPlanners(name));
    });
  }

  serviceName(name: string): string {
    return `${this.namespace.value ?? ""}/${name}`;
  }

  /** Find a path from start to goal, and show it. */
  async plan(): Promise<void> {
    await this.run("Planning", (display) =>
      display.settings.cartesian.value.peek() ? this.planStraight(display) : this.planFreely(display, true),
    );
  }

  async planAndExecute(): Promise<void> {
    const isStraight = this.display.peek()?.settings.cartesian.value.peek() === true;
    if (!isStraight) await this.run("Planning and executing", (display) => this.planFreely(display, false));
    else {
      await this.plan();
      if (this.outcome.peek()?.isDone === true) await this.execute();
    }
  }

  /** Move the robot along the planned path. */
  async execute(): Promise<void> {
    const trajectory = this.planned.peek();
    if (trajectory === null) return;
    await this.run("Executing", async () => {
      if (this.execution === null) return failure("No node has the action execute_trajectory.");
      const result = await this.execution.send({ trajectory: trajectory });
      const code = codeOf(result);
      return { isDone: code === SUCCESS, text: code === SUCCESS ? "Executed." : words(code) };
    });
  }

  /** Stop the robot, whoever moves it by move_group, and the planning. */
  stop(): void {
    this.page.connection.publish(this.serviceName("trajectory_execution_event"), "std_msgs/String", { data: "stop" });
    this.planning?.cancel();
    this.execution?.cancel();
  }

  /** Call a service of move_group without arguments, for example clear_octomap. */
  async call(name: string): Promise<void> {
    const service = this.serviceName(name);
    try {
      await this.page.connection.callService(service, {});
      this.outcome.value = { isDone: true, text: `${service} is done.` };
    } catch (error) {
      this.outcome.value = failure(`${service}: ${sentence(error)}`);
    }
  }

  private async run(task: Task, act: (display: MotionPlanningDisplay) => Promise<Outcome>): Promise<void> {
    const display = this.display.peek();
    if (display === null || this.task.peek() !== null) return;
    this.task.value = task;
    for (const query of [display.startQuery, display.goalQuery]) query.keep();
    const from = performance.now();
    try {
      const { isDone, text } = await act(display);
      this.outcome.value = { isDone, text: `${text} (${fixed((performance.now() - from) / 1000, 2)} s)` };
    } catch (error) {
      this.outcome.value = failure(sentence(error));
    } finally {
      this.task.value = null;
    }
  }

  private async planFreely(display: MotionPlanningDisplay, planOnly: boolean): Promise<Outcome> {
    const [model, group] = [display.model, display.group.peek()];
    if (model === null || group === null) return failure("There is no planning group: see the display's status.");
    if (this.planning === null) return failure("No node has the action move_group.");
    const chosen: Planner = { pipeline: this.pipeline.peek(), planner: this.planner.peek() };
    const result = await this.planning.send(moveGroupGoal(display, model, group, chosen, planOnly));
    const code = codeOf(result);
    this.planned.value =
      planOnly && code === SUCCESS ? (result["planned_trajectory"] as unknown as RobotTrajectory) : null;
    if (code !== SUCCESS) return failure(words(code));
    const time = Number(result["planning_time"]);
    const planning = `Planned in ${fixed(time, 2)} s`;
    return planOnly
      ? { isDone: true, text: `${planning}: ${described(this.planned.value)}.` }
      : { isDone: true, text: `${planning} and executed.` };
  }

  private async planStraight(display: MotionPlanningDisplay): Promise<Outcome> {
    const [model, group] = [display.model, display.group.peek()];
    if (model === null || group === null) return failure("There is no planning group: see the display's status.");
    const request = cartesianRequest(display, model, group, display.currentRoot);
    if (request === null) return failure(`${group.name} has no tip that a straight line could lead.`);
    const answer = await this.page.connection.callService(this.serviceName("compute_cartesian_path"), request);
    const [code, part] = [codeOf(answer), Number(answer["fraction"])];
    const { velocityScaling, accelerationScaling } = display.settings;
    const isWhole = code === SUCCESS && part >= 1;
    const path = slowed(
      answer["solution"] as unknown as RobotTrajectory,
      velocityScaling.value.peek(),
      accelerationScaling.value.peek(),
    );
    this.planned.value = isWhole ? path : null;
    if (isWhole) return { isDone: true, text: `A straight path: ${described(path)}.` };
    return failure(
      code === SUCCESS ? `Only ${fixed(100 * part, 0)} % of the straight line can be followed.` : words(code),
    );
  }

  private async askPlanners(service: string): Promise<void> {
    try {
      const answer = await this.page.connection.callService(service, {});
      this.planners.value = answer["planner_interfaces"] as unknown as readonly PlannerInterfaceDescription[];
    } catch (error) {
      this.outcome.value = failure(`${service}: ${sentence(error)}`);
    }
  }

  private connect(namespace: string): () => void {
    const { connection } = this.page;
    const planning = new ActionClient(connection, `${namespace}/move_group`, "moveit_msgs/MoveGroupActionGoal");
    const execution = new ActionClient(
      connection,
      `${namespace}/execute_trajectory`,
      "moveit_msgs/ExecuteTrajectoryActionGoal",
    );
    [this.planning, this.execution] = [planning, execution];
    return () => {
      planning.close();
      execution.close();
      this.planning = this.execution = null;
    };
  }
}

export const motionPlanningState = perPage((page) => new MotionPlanningState(page));

function failure(text: string): Outcome {
  return { isDone: false, text };
}

function codeOf(result: RosMessage): number {
  return (result["error_code"] as { readonly val: number }).val;
}

function described(trajectory: RobotTrajectory | null): string {
  const points = trajectory?.joint_trajectory.points ?? [];
  const last = points.at(-1);
  return `${count(points.length, "point")}, ${fixed(last === undefined ? 0 : seconds(last.time_from_start), 1)} s`;
}
