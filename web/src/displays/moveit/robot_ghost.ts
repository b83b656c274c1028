/** A robot posed by its joints: a planned state, a state of a trajectory, the planning scene's robot. */

import { Group, Matrix4, Quaternion, Vector3 } from "three";

import type { Connection } from "../../protocol/connection";
import type { Rgb } from "../../rviz/properties";
import type { KeyedProperty } from "../keyed_property";
import { LinkView, type LinkProperty } from "../robot/link_view";
import type { OnMissing } from "../robot/link_shape";
import type { ArmModel, Positions } from "./arm_model";

export interface GhostLook {
  readonly visual: boolean;
  readonly collision: boolean;
  readonly alpha: number;
  /** Color of all links; null: their own. */
  readonly color: Rgb | null;
  /** Colors of single links, before that of all. */
  readonly links?: ReadonlyMap<string, Rgb>;
  /** Links that are shown; absent: all. */
  readonly only?: ReadonlySet<string>;
}

const scale = new Vector3();

export class RobotGhost extends Group {
  /** Poses of the links in the model's frame. */
  poses: ReadonlyMap<string, Matrix4> = new Map();
  private readonly views: readonly LinkView[];

  constructor(
    readonly model: ArmModel,
    connection: Connection,
    rows: KeyedProperty<LinkProperty>,
    onMissing: OnMissing,
    onChange: () => void,
  ) {
    super();
    this.views = model.robot.links.map((link) => new LinkView(connection, link, rows, onMissing, onChange));
    for (const view of this.views) super.add(view);
  }

  /** Pose all links; `root`: pose of the root link in the model's frame. */
  pose(positions: Positions, root: Matrix4): void {
    this.poses = this.model.forward(positions, root);
    for (const view of this.views) {
      const pose = this.poses.get(view.name);
      view.visible = pose !== undefined;
      if (pose === undefined) continue;
      const transform = { position: new Vector3(), orientation: new Quaternion() };
      pose.decompose(transform.position, transform.orientation, scale);
      view.place(transform);
    }
  }

  paint({ visual, collision, alpha, color, links, only }: GhostLook): void {
    for (const view of this.views) {
      const isShown = only === undefined || only.has(view.name);
      view.setColor(links?.get(view.name) ?? color);
      view.show(visual && isShown, collision && isShown, alpha);
    }
  }

  override dispose(): void {
    for (const view of this.views) view.dispose();
    this.removeFromParent();
  }
}
