/** Robot that plans: its URDF's joints with the groups and states of its SRDF, and forward kinematics. */

import { Euler, Matrix4, Quaternion, Vector3 } from "three";

import type { Robot, RobotJoint } from "../robot/urdf";
import type { EndEffector, Srdf, SrdfGroup } from "./srdf";

/** Positions by joint [rad, m]. */
export type Positions = ReadonlyMap<string, number>;

/** Range of a joint without limits: continuous ones as MoveIt has them [rad]. */
const FREE = Math.PI;
const MOVING: ReadonlySet<string> = new Set(["revolute", "continuous", "prismatic"]);
/** Groups within groups that are followed. */
const MAX_DEPTH = 16;

export interface ArmJoint {
  readonly name: string;
  readonly isLinear: boolean;
  readonly isContinuous: boolean;
  /** Limits [rad, m]. */
  readonly lower: number;
  readonly upper: number;
}

export interface ArmGroup {
  readonly name: string;
  /** Joints that are planned: neither fixed nor passive, nor following another one; parents first. */
  readonly joints: readonly ArmJoint[];
  readonly links: ReadonlySet<string>;
  /** Links whose poses a person drags: the ends of the group's chains, or where its end effectors sit. */
  readonly tips: readonly string[];
  readonly states: ReadonlyMap<string, Positions>;
  /** Links of the end effectors on the group's tips. */
  readonly effectorLinks: ReadonlySet<string>;
}

export class ArmModel {
  readonly rootLink: string;
  /** Frame of the model: the virtual joint's parent, or the root link. */
  readonly frame: string;
  /** Virtual joint between that frame and the root link; "": none. */
  readonly virtualJoint: string;
  readonly groups: readonly ArmGroup[];
  readonly joints: readonly ArmJoint[];
  /** Joints from the root on. */
  private readonly ordered: readonly RobotJoint[];
  private readonly byChild: ReadonlyMap<string, RobotJoint>;

  constructor(
    readonly robot: Robot,
    private readonly srdf: Srdf,
  ) {
    this.byChild = new Map(robot.joints.map((joint) => [joint.child, joint]));
    this.rootLink = robot.links.find(({ name }) => !this.byChild.has(name))?.name ?? "";
    this.ordered = ordered(robot, this.rootLink);
    this.joints = this.ordered.filter((joint) => this.isActive(joint)).map(armJoint);
    const virtual = srdf.virtualJoints.find(({ childLink }) => childLink === this.rootLink);
    this.frame = virtual?.parentFrame.replace(/^\//, "") || this.rootLink;
    this.virtualJoint = virtual?.name ?? "";
    this.groups = srdf.groups.map((group) => this.makeGroup(group));
  }

  group(name: string): ArmGroup | undefined {
    return this.groups.find((group) => group.name === name);
  }

  /** Positions of all joints, those that follow others too. */
  complete(positions: Positions): Map<string, number> {
    const all = new Map<string, number>();
    for (const joint of this.ordered) all.set(joint.name, positions.get(joint.name) ?? neutral(joint));
    for (const { name, mimic } of this.ordered)
      if (mimic !== null) all.set(name, mimic.multiplier * (all.get(mimic.joint) ?? 0) + mimic.offset);
    return all;
  }

  /** Poses of all links in the model's frame; `root` is the root link's there. */
  forward(positions: Positions, root: Matrix4): Map<string, Matrix4> {
    const all = this.complete(positions);
    const poses = new Map([[this.rootLink, root.clone()]]);
    for (const joint of this.ordered) {
      const parent = poses.get(joint.parent);
      if (parent === undefined) continue;
      poses.set(
        joint.child,
        parent
          .clone()
          .multiply(originOf(joint))
          .multiply(motion(joint, all.get(joint.name) ?? 0)),
      );
    }
    return poses;
  }

  /** Names of joints whose positions are beyond their limits. */
  violations(positions: Positions): readonly string[] {
    return this.joints
      .filter(({ name, isContinuous, lower, upper }) => {
        const value = positions.get(name);
        return !isContinuous && value !== undefined && (value < lower - 1e-6 || value > upper + 1e-6);
      })
      .map(({ name }) => name);
  }

  /** Link that a joint moves. */
  childOf(joint: string): string {
    return this.ordered.find(({ name }) => name === joint)?.child ?? "";
  }

  private isActive(joint: RobotJoint): boolean {
    return MOVING.has(joint.type) && joint.mimic === null && !this.srdf.passiveJoints.has(joint.name);
  }

  private makeGroup(group: SrdfGroup): ArmGroup {
    const joints = this.jointNames(group, 0);
    const links = new Set([...this.ordered.filter(({ name }) => joints.has(name)).map(({ child }) => child)]);
    const effectors = this.srdf.endEffectors.filter((effector) => this.isMovedBy(effector, group, links));
    const chained = this.tipsOf(group, 0);
    const tips = effectors.length > 0 ? effectors.map(({ parentLink }) => parentLink) : chained;
    const states = this.srdf.states.filter((state) => state.group === group.name);
    return {
      name: group.name,
      joints: this.ordered.filter((joint) => joints.has(joint.name) && this.isActive(joint)).map(armJoint),
      links,
      tips: [...new Set(tips)],
      states: new Map(states.map(({ name, values }) => [name, values])),
      effectorLinks: new Set(effectors.flatMap((effector) => this.linksOf(effector))),
    };
  }

  private isMovedBy(effector: EndEffector, group: SrdfGroup, links: ReadonlySet<string>): boolean {
    if (effector.group === group.name) return false;
    return effector.parentGroup === "" ? links.has(effector.parentLink) : effector.parentGroup === group.name;
  }

  private linksOf(effector: EndEffector): readonly string[] {
    const group = this.srdf.groups.find(({ name }) => name === effector.group);
    return group === undefined ? [] : [...group.links, ...group.chains.map(({ tip }) => tip)];
  }

  private tipsOf(group: SrdfGroup, depth: number): readonly string[] {
    if (group.chains.length > 0) return group.chains.map(({ tip }) => tip);
    const nested = depth > MAX_DEPTH ? [] : this.subgroups(group).flatMap((inner) => this.tipsOf(inner, depth + 1));
    if (nested.length > 0 || group.subgroups.length > 0) return nested;
    const joints = this.jointNames(group, 0);
    const members = this.ordered.filter(({ name }) => joints.has(name));
    const ends = members.filter(({ child }) => !members.some(({ parent }) => parent === child));
    return members.length > 1 && ends.length === 1 ? ends.map(({ child }) => child) : [];
  }

  private subgroups(group: SrdfGroup): readonly SrdfGroup[] {
    return this.srdf.groups.filter(({ name }) => group.subgroups.includes(name));
  }

  private jointNames(group: SrdfGroup, depth: number): Set<string> {
    const names = new Set(group.joints);
    for (const link of group.links) {
      const joint = this.byChild.get(link);
      if (joint !== undefined) names.add(joint.name);
    }
    for (const { base, tip } of group.chains) for (const name of this.chain(base, tip)) names.add(name);
    if (depth <= MAX_DEPTH)
      for (const inner of this.subgroups(group)) for (const name of this.jointNames(inner, depth + 1)) names.add(name);
    return names;
  }

  private chain(base: string, tip: string): readonly string[] {
    const names: string[] = [];
    for (let link = tip; link !== base && names.length <= this.ordered.length; ) {
      const joint = this.byChild.get(link);
      if (joint === undefined) return [];
      names.push(joint.name);
      link = joint.parent;
    }
    return names;
  }
}

/** Joints in the order of a walk from the root; joints of a loop, or of no tree, are left out. */
function ordered(robot: Robot, root: string): readonly RobotJoint[] {
  const below = new Map<string, RobotJoint[]>();
  for (const joint of robot.joints) below.set(joint.parent, [...(below.get(joint.parent) ?? []), joint]);
  const all: RobotJoint[] = [];
  const seen = new Set([root]);
  const waiting = [...(below.get(root) ?? [])].reverse();
  for (let joint = waiting.pop(); joint !== undefined; joint = waiting.pop()) {
    if (seen.has(joint.child)) continue;
    seen.add(joint.child);
    all.push(joint);
    waiting.push(...[...(below.get(joint.child) ?? [])].reverse());
  }
  return all;
}

function armJoint({ name, type, lower, upper }: RobotJoint): ArmJoint {
  const isContinuous = type === "continuous";
  const hasLimits = !isContinuous && lower !== null && upper !== null && lower < upper;
  return {
    name,
    isLinear: type === "prismatic",
    isContinuous,
    lower: hasLimits ? lower : -FREE,
    upper: hasLimits ? upper : FREE,
  };
}

/** Position of a joint that no message names: 0, or the middle of limits that exclude it. */
function neutral({ type, lower, upper }: RobotJoint): number {
  if (type === "continuous" || lower === null || upper === null || lower >= upper) return 0;
  return lower <= 0 && upper >= 0 ? 0 : (lower + upper) / 2;
}

const axis = new Vector3();
const turn = new Quaternion();
const ONE = new Vector3(1, 1, 1);

function originOf({ origin: { xyz, rpy } }: RobotJoint): Matrix4 {
  turn.setFromEuler(new Euler(rpy[0], rpy[1], rpy[2], "ZYX"));
  return new Matrix4().compose(new Vector3(...xyz), turn, ONE);
}

function motion({ type, axis: along }: RobotJoint, position: number): Matrix4 {
  axis.set(...along).normalize();
  if (type === "prismatic") return new Matrix4().makeTranslation(axis.multiplyScalar(position));
  if (type === "revolute" || type === "continuous") return new Matrix4().makeRotationAxis(axis, position);
  return new Matrix4();
}
