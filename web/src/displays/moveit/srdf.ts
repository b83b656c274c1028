/** Semantic description of a robot (SRDF): groups of joints, named states, end effectors. */

import { attribute, children } from "../robot/urdf";

export interface SrdfGroup {
  readonly name: string;
  readonly chains: readonly { readonly base: string; readonly tip: string }[];
  readonly joints: readonly string[];
  readonly links: readonly string[];
  readonly subgroups: readonly string[];
}

/** A named state: `ready` of the group `panda_arm`. */
interface GroupState {
  readonly name: string;
  readonly group: string;
  /** Values by joint [rad, m]; of joints with several values, the first. */
  readonly values: ReadonlyMap<string, number>;
}

export interface EndEffector {
  readonly name: string;
  readonly parentLink: string;
  readonly group: string;
  /** Group that moves it; "": not given. */
  readonly parentGroup: string;
}

interface VirtualJoint {
  readonly name: string;
  readonly type: string;
  readonly parentFrame: string;
  readonly childLink: string;
}

export interface Srdf {
  readonly groups: readonly SrdfGroup[];
  readonly states: readonly GroupState[];
  readonly endEffectors: readonly EndEffector[];
  readonly virtualJoints: readonly VirtualJoint[];
  readonly passiveJoints: ReadonlySet<string>;
}

/** A description that cannot be read; its message is a sentence. */
export class SrdfError extends Error {}

export function readSrdf(text: string): Srdf {
  const document = new DOMParser().parseFromString(text.trimStart(), "application/xml");
  const fault = document.querySelector("parsererror")?.textContent.trim().split("\n")[0];
  if (fault !== undefined) throw new SrdfError(`The semantic description is not XML: ${fault}`);
  const robot = document.documentElement;
  if (robot.nodeName !== "robot")
    throw new SrdfError(`The semantic description begins with <${robot.nodeName}>, not <robot>.`);
  return {
    groups: children(robot, "group").map(readGroup),
    states: children(robot, "group_state").map(readState),
    endEffectors: children(robot, "end_effector").map((node) => ({
      name: attribute(node, "name"),
      parentLink: attribute(node, "parent_link"),
      group: attribute(node, "group"),
      parentGroup: attribute(node, "parent_group"),
    })),
    virtualJoints: children(robot, "virtual_joint").map((node) => ({
      name: attribute(node, "name"),
      type: attribute(node, "type"),
      parentFrame: attribute(node, "parent_frame"),
      childLink: attribute(node, "child_link"),
    })),
    passiveJoints: new Set(children(robot, "passive_joint").map((node) => attribute(node, "name"))),
  };
}

function readGroup(node: Element): SrdfGroup {
  const names = (tag: string): readonly string[] => children(node, tag).map((child) => attribute(child, "name"));
  return {
    name: attribute(node, "name"),
    chains: children(node, "chain").map((chain) => ({
      base: attribute(chain, "base_link"),
      tip: attribute(chain, "tip_link"),
    })),
    joints: names("joint"),
    links: names("link"),
    subgroups: names("group"),
  };
}

function readState(node: Element): GroupState {
  const values = children(node, "joint").flatMap((joint): (readonly [string, number])[] => {
    const value = Number.parseFloat(attribute(joint, "value"));
    return Number.isFinite(value) ? [[attribute(joint, "name"), value]] : [];
  });
  return { name: attribute(node, "name"), group: attribute(node, "group"), values: new Map(values) };
}
