/** Planned path in the scene: an animated robot, and a trail of its states. */

import { effect, untracked } from "@preact/signals";
import { Matrix4 } from "three";

import type { DisplayTrajectory } from "../../protocol/generated/ros_messages";
import {
  BoolProperty,
  ColorProperty,
  EnumProperty,
  IntProperty,
  NumberProperty,
  TopicProperty,
  type Property,
} from "../../rviz/properties";
import { KeyedProperty } from "../keyed_property";
import type { LinkProperty } from "../robot/link_view";
import { readValues } from "../watch";
import type { ArmModel, Positions } from "./arm_model";
import { Playback, type PlaybackSettings } from "./playback";
import type { GhostLook, RobotGhost } from "./robot_ghost";
import { positionsOf, rootOf } from "./robot_state";
import { waypointsOf, type Waypoint } from "./trajectory";

export const TRAJECTORY = "moveit_msgs/DisplayTrajectory";
/** Largest number of robots in a trail. */
const MAX_TRAIL = 100;

/** rviz's rows of a planned path; `add` puts each below its heading. */
export class PathProperties {
  readonly topic: TopicProperty;
  readonly visual: BoolProperty;
  readonly collision: BoolProperty;
  readonly alpha: NumberProperty;
  readonly displayTime: EnumProperty;
  readonly useSimTime: BoolProperty;
  readonly loop: BoolProperty;
  readonly trail: BoolProperty;
  readonly trailStep: IntProperty;
  readonly interrupt: BoolProperty;
  readonly color: ColorProperty;
  readonly isColored: BoolProperty;
  readonly links: KeyedProperty<LinkProperty>;

  constructor(add: <P extends Property<unknown>>(property: P) => P) {
    this.topic = add(new TopicProperty("Trajectory Topic", "move_group/display_planned_path", [TRAJECTORY]));
    this.visual = add(new BoolProperty("Show Robot Visual", true));
    this.collision = add(new BoolProperty("Show Robot Collision", false));
    this.alpha = add(new NumberProperty("Robot Alpha", 0.5, { min: 0, max: 1 }));
    this.displayTime = add(
      new EnumProperty("State Display Time", "3x", ["3x", "1x", "0.5x", "REALTIME", "0.05 s", "0.1 s", "0.5 s"], {
        open: true,
        description: "A factor of the path's own time (3x, REALTIME), or the time for each waypoint (0.05 s).",
      }),
    );
    this.useSimTime = add(new BoolProperty("Use Sim Time", false));
    this.loop = add(new BoolProperty("Loop Animation", false));
    this.trail = add(new BoolProperty("Show Trail", false));
    this.trailStep = add(new IntProperty("Trail Step Size", 1, { min: 1 }));
    this.interrupt = add(new BoolProperty("Interrupt Display", false));
    this.color = add(new ColorProperty("Robot Color", [150, 50, 150]));
    this.isColored = add(new BoolProperty("Color Enabled", false));
    this.links = add(new KeyedProperty<LinkProperty>("Links"));
  }

  get settings(): PlaybackSettings {
    return {
      loop: this.loop.value.peek(),
      interrupt: this.interrupt.value.peek(),
      displayTime: this.displayTime.value.peek(),
    };
  }
}

export type MakeGhost = (model: ArmModel, rows: KeyedProperty<LinkProperty>) => RobotGhost;

export class PathView {
  readonly playback = new Playback();
  private readonly ghost: RobotGhost;
  private trail: RobotGhost[] = [];
  private readonly stops: (() => void)[];
  private start: Positions = new Map();
  private root = new Matrix4();
  private lastNow: bigint | null = null;

  constructor(
    readonly model: ArmModel,
    private readonly properties: PathProperties,
    private readonly makeGhost: MakeGhost,
    private readonly onChange: () => void,
  ) {
    this.ghost = makeGhost(model, properties.links);
    const { trail, trailStep, ...others } = properties;
    const painted = [others.visual, others.collision, others.alpha, others.color, others.isColored, others.links];
    this.stops = [
      effect(() => {
        readValues(painted);
        untracked(() => this.paint());
      }),
      effect(() => {
        const index = this.playback.index.value;
        const waypoint = this.playback.path.value[index];
        untracked(() => this.stand(waypoint));
      }),
      effect(() => {
        const steps = trail.value.value ? trailStep.value.value : 0;
        const path = this.playback.path.value;
        untracked(() => this.drawTrail(path, steps));
      }),
    ];
  }

  /** Show the trajectory of a message, from its start state; what that does not name, the current state has. */
  receive({ trajectory, trajectory_start: start }: DisplayTrajectory, current: Positions, root: Matrix4): void {
    this.start = new Map([...current, ...positionsOf(start.joint_state)]);
    this.root = rootOf(this.model, start) ?? root.clone();
    this.playback.show(waypointsOf(this.model, trajectory), this.properties.settings);
  }

  /** Advance the animation: by ROS time [ns] where the display uses it, otherwise by wall seconds. */
  update(now: bigint, elapsed: number): void {
    const simulated = this.lastNow === null ? 0 : Number(now - this.lastNow) / 1e9;
    this.lastNow = now;
    const passed = this.properties.useSimTime.value.peek() ? Math.max(0, simulated) : elapsed;
    this.playback.advance(passed, this.properties.settings);
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    for (const ghost of [this.ghost, ...this.trail]) ghost.dispose();
  }

  private get look(): GhostLook {
    const { visual, collision, alpha, color, isColored } = this.properties;
    return {
      visual: visual.value.peek(),
      collision: collision.value.peek(),
      alpha: alpha.value.peek(),
      color: isColored.value.peek() ? color.value.peek() : null,
    };
  }

  private paint(): void {
    for (const ghost of [this.ghost, ...this.trail]) ghost.paint(this.look);
    this.onChange();
  }

  private stand(waypoint: Waypoint | undefined): void {
    this.ghost.visible = waypoint !== undefined;
    if (waypoint !== undefined) this.pose(this.ghost, waypoint);
    this.onChange();
  }

  private pose(ghost: RobotGhost, { positions, root }: Waypoint): void {
    ghost.pose(new Map([...this.start, ...positions]), root ?? this.root);
  }

  private drawTrail(path: readonly Waypoint[], step: number): void {
    for (const ghost of this.trail) ghost.dispose();
    const stride = Math.max(step, Math.ceil(path.length / MAX_TRAIL));
    const states = step === 0 ? [] : path.filter((_, index) => index % stride === 0);
    this.trail = states.map((waypoint) => {
      const ghost = this.makeGhost(this.model, new KeyedProperty<LinkProperty>("Links"));
      this.pose(ghost, waypoint);
      return ghost;
    });
    this.paint();
  }
}
