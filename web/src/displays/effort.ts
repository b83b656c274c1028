/** Effort: a ring about each turning joint, whose size grows with the effort. */

import { untracked } from "@preact/signals";
import { Group, Quaternion, Vector3 } from "three";

import { NoTransform, type Transform } from "../frames/transform";
import type { JointState } from "../protocol/generated/ros_messages";
import { RAINBOW } from "./clouds/cloud_colors";
import type { DisplayContext } from "./display";
import { KeyedProperty } from "./keyed_property";
import { BoolProperty, IntProperty, NumberProperty, StringProperty } from "../rviz/properties";
import { register } from "./registry";
import { readUrdf, UrdfError, type RobotJoint } from "./robot/urdf";
import { Arrow } from "../shapes/arrow";
import { BillboardLines } from "../shapes/billboard_lines";
import { TopicDisplay } from "./topic_display";

/** Number of points of a ring, and of the parts of a full circle: the ring is open, as rviz's. */
const POINTS = 30;
const PARTS = 32;
/** Measured on pictures of rviz: the drawn value is the effort's ratio plus an offset, and sets the radius [m]. */
const OFFSET = 0.05;
const RADIUS = 0.05;
const GROWTH = 0.5;

const Z = new Vector3(0, 0, 1);

/** A ring and the arrow at its beginning. */
class EffortRing extends Group {
  private readonly line = new BillboardLines();
  private readonly arrow = new Arrow();

  constructor() {
    super();
    super.add(this.line, this.arrow);
  }

  /** `share`: effort as a signed ratio of the largest effort; the ring lies in the group's xy plane. */
  draw(share: number, scale: number, width: number, alpha: number): void {
    const value = Math.min(1, Math.abs(share)) + OFFSET;
    const radius = RADIUS + value * scale * GROWTH;
    const side = share < 0 ? -1 : 1;
    const points: number[] = [];
    for (let k = 0; k < POINTS; k++) {
      const angle = (2 * Math.PI * k) / PARTS;
      points.push(side * radius * Math.sin(angle), radius * Math.cos(angle), 0);
    }
    const rgba = [...rainbow(value), alpha] as const;
    this.line.setWidth(width);
    this.line.begin();
    this.line.addPolyline(points, rgba);
    this.line.finish();
    this.arrow.setProportions({
      shaftLength: 0,
      shaftDiameter: 2 * width,
      headLength: 2 * width,
      headDiameter: 4 * width,
    });
    this.arrow.setColor([rgba[0] * 255, rgba[1] * 255, rgba[2] * 255], alpha);
    this.arrow.position.set(0, radius, 0);
    this.arrow.quaternion.setFromAxisAngle(Z, side > 0 ? Math.PI : 0);
  }

  override dispose(): void {
    this.line.dispose();
    this.arrow.dispose();
  }
}

/** rviz's rainbow: 0 is magenta, 1 is red. */
export function rainbow(value: number): readonly [number, number, number] {
  const at = Math.min(1, Math.max(0, value)) * (RAINBOW.length - 1);
  const [from, to] = [RAINBOW[Math.floor(at)] ?? RAINBOW[0], RAINBOW[Math.ceil(at)] ?? RAINBOW[0]];
  const mix = (part: 0 | 1 | 2): number => from[part] + (to[part] - from[part]) * (at % 1);
  return [mix(0), mix(1), mix(2)];
}

export class Effort extends TopicDisplay<JointState> {
  readonly className = "rviz/Effort";
  private readonly alpha = this.add(new NumberProperty("Alpha", 1, { min: 0, max: 1 }));
  private readonly width = this.add(new NumberProperty("Width", 0.02, { min: 0, unit: "m" }));
  private readonly scale = this.add(new NumberProperty("Scale", 1, { min: 0 }));
  private readonly history = this.add(new IntProperty("History Length", 1, { min: 1 }));
  private readonly description = this.add(new StringProperty("Robot Description", "robot_description"));
  private readonly prefix = this.add(new StringProperty("TF Prefix", ""));
  private readonly rows = this.add(new KeyedProperty<BoolProperty>("Joints"));
  private joints = new Map<string, RobotJoint>();
  private shown: readonly Map<string, EffortRing>[] = [];

  constructor(context: DisplayContext) {
    super(context, ["sensor_msgs/JointState"]);
  }

  protected override onStart(): void {
    this.whileEnabled(() => {
      const name = this.description.value.value;
      const text = this.parameter(name);
      untracked(() => this.describe(name, text));
    });
    super.onStart();
  }

  /** The fixed frame, since each joint has a frame of its own and only the stamp counts. */
  protected override frameOf(): string {
    return this.context.fixedFrame.peek();
  }

  protected process(message: JointState): void {
    const rings = new Map<string, EffortRing>();
    message.name.forEach((name, index) => {
      const joint = this.joints.get(name);
      const effort = message.effort[index];
      if (joint === undefined || effort === undefined || (joint.effort ?? 0) <= 0) return;
      if (this.rows.get(name)?.value.peek() === false) return;
      const ring = this.ringAt(joint);
      if (ring === null) return;
      ring.draw(
        effort / (joint.effort ?? 1),
        this.scale.value.peek(),
        this.width.value.peek(),
        this.alpha.value.peek(),
      );
      rings.set(name, ring);
      this.root.add(ring);
    });
    this.shown = [...this.shown, rings];
    this.forgetOld(this.history.value.peek());
  }

  protected clear(): void {
    this.forgetOld(0);
  }

  private forgetOld(count: number): void {
    const removed = this.shown.slice(0, Math.max(0, this.shown.length - count));
    for (const ring of removed.flatMap((rings) => [...rings.values()])) {
      ring.removeFromParent();
      ring.dispose();
    }
    this.shown = this.shown.slice(removed.length);
  }

  /** A ring at a joint's child with its axis along the joint's; null: the link has no transform. */
  private ringAt(joint: RobotJoint): EffortRing | null {
    const prefix = this.prefix.value.peek();
    const frame = prefix === "" ? joint.child : `${prefix}/${joint.child}`;
    const transform: Transform | NoTransform = this.context.frames.lookup(this.context.fixedFrame.peek(), frame, 0n);
    if (transform instanceof NoTransform) {
      this.setStatus(joint.name, "error", transform.text, transform.advice);
      return null;
    }
    this.setStatus(joint.name, "ok", "OK");
    const ring = new EffortRing();
    const axis = new Vector3(...joint.axis).normalize();
    ring.position.copy(transform.position);
    ring.quaternion.copy(transform.orientation).multiply(new Quaternion().setFromUnitVectors(Z, axis));
    return ring;
  }

  private describe(name: string, text: unknown): void {
    this.joints = new Map();
    if (typeof text !== "string") {
      this.setStatus("URDF", "error", `Parameter [${name}] does not exist, and was not found by searchParam()`);
      return;
    }
    try {
      for (const joint of readUrdf(text).joints) {
        if (joint.type !== "revolute" && joint.type !== "continuous") continue;
        this.joints.set(joint.name, joint);
        this.rows.row(joint.name, () => new BoolProperty(joint.name, true));
      }
      this.setStatus("URDF", "ok", "URDF parsed OK");
    } catch (error) {
      if (!(error instanceof UrdfError)) throw error;
      this.setStatus("URDF", "error", "URDF failed Model parse", error.message);
    }
  }
}

register({ className: "rviz/Effort", aliases: [], types: [], create: (context) => new Effort(context) });
