/** Link in the scene: its visuals and collisions, and its axes and trail if enabled. */

import { Group } from "three";

import type { Transform } from "../../frames/transform";
import type { Connection } from "../../protocol/connection";
import type { Selectable } from "../../scene/scene_view";
import type { KeyedProperty } from "../keyed_property";
import { BoolProperty, GroupProperty, NumberProperty, type Rgb } from "../../rviz/properties";
import { Axes } from "../../shapes/axes";
import { Trail } from "../../shapes/trail";
import { LinkShapes, type OnMissing } from "./link_shape";
import type { RobotLink } from "./urdf";

/** A link's row: with a checkbox where the link has a shape. */
export type LinkProperty = BoolProperty | GroupProperty;

/** Size of a link's axes in rviz [m]. */
const AXES = { length: 0.1, radius: 0.01 } as const;

export class LinkView extends Group {
  readonly visuals: LinkShapes;
  readonly collisions: LinkShapes;
  private readonly row: LinkProperty;
  private readonly alpha: NumberProperty;
  private readonly showAxes: BoolProperty;
  private readonly showTrail: BoolProperty;
  private axes: Axes | null = null;
  private trail: Trail | null = null;

  constructor(
    connection: Connection,
    link: RobotLink,
    rows: KeyedProperty<LinkProperty>,
    onMissing: OnMissing,
    onChange: () => void,
  ) {
    super();
    this.name = link.name;
    const color = link.visuals[0]?.material ?? null; // rviz's color of shapes that have none
    this.visuals = new LinkShapes(connection, link.visuals, color, onMissing, onChange);
    this.collisions = new LinkShapes(connection, link.collisions, color, onMissing, onChange);
    super.add(this.visuals, this.collisions);
    this.alpha = new NumberProperty("Alpha", 1, { min: 0, max: 1 });
    this.showAxes = new BoolProperty("Show Axes", false);
    this.showTrail = new BoolProperty("Show Trail", false);
    this.row = rows.row(link.name, () => this.makeRow(link));
    const selectable: Selectable = {
      describe: () => ({ Link: link.name, Position: this.position.toArray(), Orientation: this.quaternion.toArray() }),
    };
    this.userData["selectable"] = selectable;
  }

  /** Pose in the fixed frame, null: there is no transform; true: something changed. */
  place(pose: Transform | null): boolean {
    const changed = this.visuals.setPlaced(pose !== null);
    this.collisions.setPlaced(pose !== null);
    if (pose === null || (this.position.equals(pose.position) && this.quaternion.equals(pose.orientation)))
      return changed;
    this.position.copy(pose.position);
    this.quaternion.copy(pose.orientation);
    this.trail?.follow(pose.position);
    return true;
  }

  /** Color all shapes; null: their own colors. */
  setColor(color: Rgb | null): void {
    this.visuals.setColor(color);
    this.collisions.setColor(color);
  }

  /** Show the link by the robot's properties and its own. */
  show(visual: boolean, collision: boolean, alpha: number): void {
    const enabled = this.row.value.peek() !== false;
    const linkAlpha = alpha * this.alpha.value.peek();
    this.visuals.visible = enabled && visual;
    this.collisions.visible = enabled && collision;
    this.visuals.setAlpha(linkAlpha);
    this.collisions.setAlpha(linkAlpha);
    this.updateAxes(enabled && this.showAxes.value.peek());
    this.updateTrail(enabled && this.showTrail.value.peek());
  }

  override dispose(): void {
    this.visuals.dispose();
    this.collisions.dispose();
    this.updateAxes(false);
    this.updateTrail(false);
  }

  private makeRow(link: RobotLink): LinkProperty {
    const hasShape = link.visuals.length + link.collisions.length > 0;
    const row = hasShape ? new BoolProperty(link.name, true) : new GroupProperty(link.name);
    for (const property of [this.alpha, this.showAxes, this.showTrail]) row.add(property);
    return row;
  }

  private updateAxes(shown: boolean): void {
    if (shown === (this.axes !== null)) return;
    this.axes?.removeFromParent();
    this.axes?.dispose();
    this.axes = shown ? new Axes(AXES.length, AXES.radius) : null;
    if (this.axes !== null) super.add(this.axes);
  }

  /** The trail stands in the fixed frame, beside the link. */
  private updateTrail(shown: boolean): void {
    if (shown === (this.trail !== null)) return;
    this.trail?.removeFromParent();
    this.trail?.dispose();
    this.trail = shown ? new Trail() : null;
    if (this.trail !== null) this.parent?.add(this.trail);
  }
}
