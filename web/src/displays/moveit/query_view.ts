/** A query in the scene: the robot in its state, and a marker at each tip that a person drags. */

import { effect, untracked } from "@preact/signals";
import type { Group, Matrix4 } from "three";

import type { Transform } from "../../frames/transform";
import type { Pose } from "../../protocol/generated/ros_messages";
import type { BoolProperty, ColorProperty, NumberProperty, Rgb } from "../../rviz/properties";
import type { DisplayContext } from "../display";
import type { ArmGroup, ArmModel } from "./arm_model";
import { LocalMarker } from "./local_marker";
import type { Query } from "./query";
import type { RobotGhost } from "./robot_ghost";
import { poseOf } from "./robot_state";

export interface QueryLook {
  readonly shown: BoolProperty;
  readonly color: ColorProperty;
  readonly alpha: NumberProperty;
  readonly colliding: ColorProperty;
  readonly violation: ColorProperty;
  readonly markerSize: NumberProperty;
}

export interface QueryViewParts {
  readonly context: DisplayContext;
  /** Group in the axes of the fixed frame. */
  readonly root: Group;
  /** Pose of the model's frame in the fixed frame, and of the root link in the model's frame. */
  readonly anchor: () => Transform | null;
  readonly rootPose: () => Matrix4;
  readonly look: QueryLook;
  /** A person drags a tip to a pose in the model's frame. */
  readonly onDrag: (tip: string, pose: Pose) => void;
  readonly onRelease: () => void;
}

export class QueryView {
  private readonly markers = new Map<string, LocalMarker>();
  private readonly stops: (() => void)[];
  private readonly moved: ReadonlySet<string>;
  /** Color of the markers' balls: of a state that cannot be; null: their own. */
  private bad: Rgb | null = null;

  constructor(
    readonly query: Query,
    private readonly group: ArmGroup,
    private readonly ghost: RobotGhost,
    private readonly parts: QueryViewParts,
  ) {
    this.moved = movedLinks(ghost.model, group);
    const { shown, color, alpha, colliding, violation, markerSize } = parts.look;
    this.stops = [
      effect(() => {
        const isShown = shown.value.value;
        const size = markerSize.value.value;
        const base = color.value.value;
        untracked(() => this.makeMarkers(isShown, size, base));
      }),
      effect(() => {
        const positions = query.positions.value;
        untracked(() => {
          ghost.pose(positions, parts.rootPose());
          this.placeMarkers();
        });
      }),
      effect(() => {
        const look = {
          isShown: shown.value.value,
          color: color.value.value,
          alpha: alpha.value.value,
          links: this.linkColors(query, colliding.value.value, violation.value.value),
        };
        const bad = query.isUnreachable.value || query.colliding.value.size > 0 ? colliding.value.value : null;
        untracked(() => this.paint(look, bad));
      }),
    ];
  }

  /** Follow camera and frames; once per frame. */
  update(elapsed: number): void {
    for (const marker of this.markers.values()) marker.update(elapsed);
  }

  /** Put the markers where the tips are: after a drag to where nothing reaches. */
  placeMarkers(): void {
    for (const [tip, marker] of this.markers) {
      const pose = this.ghost.poses.get(tip);
      if (pose !== undefined) marker.place(poseOf(pose));
    }
    this.parts.context.scene.invalidate();
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    this.dropMarkers();
    this.ghost.dispose();
  }

  private linkColors(query: Query, colliding: Rgb, violation: Rgb): ReadonlyMap<string, Rgb> {
    const colors = new Map<string, Rgb>();
    const { model } = this.ghost;
    if (query.isUnreachable.value)
      for (const link of [...this.group.effectorLinks, ...this.group.tips]) colors.set(link, colliding);
    for (const joint of model.violations(query.positions.value)) colors.set(model.childOf(joint), violation);
    for (const body of query.colliding.value) colors.set(body, colliding);
    return colors;
  }

  private paint(
    look: {
      readonly isShown: boolean;
      readonly color: Rgb;
      readonly alpha: number;
      readonly links: ReadonlyMap<string, Rgb>;
    },
    bad: Rgb | null,
  ): void {
    this.ghost.visible = look.isShown;
    const only = new Set([...this.moved, ...look.links.keys()]);
    this.ghost.paint({ visual: true, collision: false, alpha: look.alpha, color: look.color, links: look.links, only });
    this.bad = bad;
    for (const marker of this.markers.values()) marker.tint(bad);
    this.parts.context.scene.invalidate();
  }

  private dropMarkers(): void {
    for (const marker of this.markers.values()) marker.dispose();
    this.markers.clear();
  }

  private makeMarkers(isShown: boolean, size: number, color: Rgb): void {
    this.dropMarkers();
    if (isShown) for (const tip of this.group.tips) this.makeMarker(tip, size, color);
    this.placeMarkers();
  }

  private makeMarker(tip: string, size: number, color: Rgb): void {
    const { context, root, anchor, onDrag, rootPose } = this.parts;
    const pose = poseOf(this.ghost.poses.get(tip) ?? rootPose());
    const name = `EE:${this.query.name}_${tip}`;
    const frame = this.ghost.model.frame;
    const marker = new LocalMarker({
      ...{ context, root, anchor, frame, name, pose, size, color },
      onDrag: (dragged) => onDrag(tip, dragged),
      onRelease: () => {
        this.parts.onRelease();
        this.placeMarkers();
      },
    });
    marker.tint(this.bad);
    this.markers.set(tip, marker);
  }
}

/** Links that a group's joints move. */
function movedLinks(model: ArmModel, group: ArmGroup): ReadonlySet<string> {
  const moved = new Set(group.joints.map(({ name }) => model.childOf(name)));
  for (let isGrowing = true; isGrowing; ) {
    isGrowing = false;
    for (const { parent, child } of model.robot.joints)
      if (moved.has(parent) && !moved.has(child)) {
        moved.add(child);
        isGrowing = true;
      }
  }
  return moved;
}
