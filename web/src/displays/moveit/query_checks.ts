/** Questions about a query to move_group: which joints reach a pose, and what touches. */

import type { Connection } from "../../protocol/connection";
import type { ContactInformation, Pose, RobotState } from "../../protocol/generated/ros_messages";
import { LatestRequest } from "../../protocol/latest_request";
import type { RosMessage } from "../../protocol/ros_types";
import type { ArmGroup, ArmModel, Positions } from "./arm_model";
import { NO_IK_SOLUTION, SUCCESS, words } from "./error_codes";
import type { Query } from "./query";
import { positionsOf, stateMessage } from "./robot_state";

/** Time for one solution [s]. */
const IK_TIMEOUT = 0.05;
/** Wall time after which a pending answer is called slow [s]. */
const SLOW_S = 1;

export interface PoseRequest {
  readonly group: ArmGroup;
  readonly tip: string;
  readonly pose: Pose;
  readonly avoidCollisions: boolean;
  /** Joints near the pose where none reaches it; null: the query stays as it is. */
  readonly nearest: ((seed: Positions) => Positions) | null;
}

export class QueryChecks {
  private readonly poses = new LatestRequest(() => undefined);
  private readonly states = new LatestRequest(() => undefined);
  private isHeld = false;
  private pending: { readonly service: string; seconds: number } | null = null;

  constructor(
    private readonly query: Query,
    private readonly connection: Connection,
    private readonly model: ArmModel,
    /** Global name of one of move_group's services. */
    private readonly service: (name: string) => string,
  ) {}

  /** Move the query to joints that put a tip at a pose in the model's frame; of waiting poses only the newest counts. */
  reach(request: PoseRequest): void {
    this.isHeld = true;
    this.poses.send(() => this.askPose(request));
  }

  /** The person lets go: the tip is where the arm is again. */
  release(): void {
    this.isHeld = false;
    this.query.isUnreachable.value = false;
  }

  /** Find what touches in the query's state. */
  check(group: ArmGroup): void {
    this.states.send(() => this.askState(group));
  }

  /** Let wall seconds pass: a slow answer is named. */
  tick(elapsed: number): void {
    if (this.pending === null) return;
    this.pending.seconds += elapsed;
    if (this.pending.seconds > SLOW_S)
      this.query.fault.value = `Waiting for ${this.pending.service} for ${Math.floor(this.pending.seconds)} s.`;
  }

  private async askPose({ group, tip, pose, avoidCollisions, nearest }: PoseRequest): Promise<boolean> {
    const { query, model } = this;
    const request = {
      group_name: group.name,
      robot_state: stateMessage(query.positions.peek()),
      avoid_collisions: avoidCollisions,
      ik_link_name: tip,
      pose_stamped: { header: { frame_id: model.frame }, pose },
      timeout: { sec: 0, nsec: IK_TIMEOUT * 1e9 },
    };
    const answer = await this.call("compute_ik", { ik_request: request });
    if (answer === null) return true;
    const code = codeOf(answer);
    if (code === SUCCESS) {
      query.set(ofGroup(group, answer["solution"] as unknown as RobotState));
      query.fault.value = "";
    } else if (code === NO_IK_SOLUTION && nearest !== null) {
      query.set(nearest(query.positions.peek()));
      query.fault.value = `No configuration of ${group.name} reaches there: this is near it.`;
    } else {
      query.isUnreachable.value = this.isHeld;
      const avoiding = avoidCollisions ? " without a collision" : "";
      query.fault.value =
        code === NO_IK_SOLUTION ? `No configuration of ${group.name} reaches there${avoiding}.` : words(code);
    }
    return true;
  }

  private async askState(group: ArmGroup): Promise<boolean> {
    const state = stateMessage(this.query.positions.peek());
    const answer = await this.call("check_state_validity", { robot_state: state, group_name: group.name });
    if (answer === null) return true;
    const contacts = answer["contacts"] as unknown as readonly ContactInformation[];
    this.query.colliding.value = new Set(
      contacts.flatMap(({ contact_body_1, contact_body_2 }) => [contact_body_1, contact_body_2]),
    );
    return true;
  }

  /** Answer of one of move_group's services; null: there is none, which the query says. */
  private async call(name: string, request: RosMessage): Promise<RosMessage | null> {
    const service = this.service(name);
    const pending = { service, seconds: 0 };
    this.pending = pending;
    try {
      const answer = await this.connection.callService(service, request);
      if (this.query.fault.peek().startsWith(`${service}: `)) this.query.fault.value = "";
      return answer;
    } catch (error) {
      this.query.fault.value = `${service}: ${error instanceof Error ? error.message : String(error)}`;
      return null;
    } finally {
      if (this.pending === pending) this.pending = null;
      if (pending.seconds > SLOW_S && this.query.fault.peek().startsWith("Waiting")) this.query.fault.value = "";
    }
  }
}

function codeOf(answer: RosMessage): number {
  const { val } = answer["error_code"] as { readonly val: number };
  return val;
}

function ofGroup(group: ArmGroup, { joint_state: joints }: RobotState): Positions {
  const names = new Set(group.joints.map(({ name }) => name));
  return new Map([...positionsOf(joints)].filter(([name]) => names.has(name)));
}
