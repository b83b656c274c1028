/** Objects of a planning scene in the model's frame, those in the robot's hands, and the octomap. */

import { Group, Matrix4, Vector3 } from "three";

import { NoTransform, type Transform } from "../../frames/transform";
import { placed } from "../../frames/valid";
import type { CollisionObject, ColorRGBA } from "../../protocol/generated/ros_messages";
import type { Rgb } from "../../rviz/properties";
import type { Instances } from "../../shapes/instances";
import { ObjectShapes } from "./object_shapes";
import { readOctomap } from "../octomaps/octomap_reader";
import type { SceneContents } from "./scene_contents";
import { voxelBoxes, type VoxelLook } from "../octomaps/voxel_boxes";

export interface SceneLook extends VoxelLook {
  readonly isShown: boolean;
  readonly alpha: number;
  readonly color: Rgb;
  readonly attachedColor: Rgb;
}

/** Pose of a frame in the model's frame. */
export type FrameInModel = (frame: string) => Transform | NoTransform;

interface Drawn {
  readonly frame: Group;
  readonly shapes: ObjectShapes;
}

export class SceneDrawing extends Group {
  private readonly drawn = new Map<string, Drawn>();
  private voxels: Instances | null = null;
  private octomapOf: unknown = null;
  private voxelLook = "";

  /** Draw the contents; objects that are unchanged keep their shapes. Returns the octomap's fault, "" if none. */
  draw(contents: SceneContents, look: SceneLook, linkPoses: ReadonlyMap<string, Matrix4>, frame: FrameInModel): string {
    this.visible = look.isShown;
    const shown = new Set<string>();
    for (const [id, object] of contents.objects) {
      const key = `object ${id}`;
      const drawn = this.keep(key, object, () => ({ Object: id, Frame: object.header.frame_id }));
      drawn.shapes.paint(colored(contents.colors.get(id), look.color, look.alpha));
      const pose = frame(object.header.frame_id);
      drawn.frame.visible = !(pose instanceof NoTransform);
      if (!(pose instanceof NoTransform)) {
        drawn.frame.position.copy(pose.position);
        drawn.frame.quaternion.copy(pose.orientation);
      }
      shown.add(key);
    }
    for (const [id, { link_name: link, object }] of contents.attached) {
      const key = `attached ${id}`;
      const drawn = this.keep(key, object, () => ({ "Attached object": id, Link: link }));
      drawn.shapes.paint(colored(contents.colors.get(id), look.attachedColor, look.alpha));
      drawn.frame.userData["link"] = object.header.frame_id === "" ? link : object.header.frame_id;
      shown.add(key);
    }
    for (const key of [...this.drawn.keys()]) if (!shown.has(key)) this.forget(key);
    this.follow(linkPoses);
    return this.drawOctomap(contents, look);
  }

  /** Move attached objects with their links. */
  follow(linkPoses: ReadonlyMap<string, Matrix4>): void {
    for (const { frame } of this.drawn.values()) {
      const link: unknown = frame.userData["link"];
      const pose = typeof link === "string" ? linkPoses.get(link) : undefined;
      if (typeof link !== "string") continue;
      frame.visible = pose !== undefined;
      pose?.decompose(frame.position, frame.quaternion, new Vector3());
    }
  }

  /** Color one object, components 0…255; null: its own color at the next `draw`. */
  highlight(id: string, color: Rgb): void {
    const [red, green, blue] = color;
    for (const key of [`object ${id}`, `attached ${id}`])
      this.drawn.get(key)?.shapes.paint([red / 255, green / 255, blue / 255, 1]);
  }

  override dispose(): void {
    for (const key of [...this.drawn.keys()]) this.forget(key);
    this.voxels?.dispose();
    this.removeFromParent();
  }

  private keep(key: string, object: CollisionObject, describe: () => Readonly<Record<string, unknown>>): Drawn {
    const known = this.drawn.get(key);
    if (known?.shapes.object === object) return known;
    this.forget(key);
    const drawn = { frame: new Group(), shapes: new ObjectShapes(object, describe) };
    drawn.frame.add(drawn.shapes);
    super.add(drawn.frame);
    this.drawn.set(key, drawn);
    return drawn;
  }

  private forget(key: string): void {
    const drawn = this.drawn.get(key);
    if (drawn === undefined) return;
    drawn.shapes.dispose();
    drawn.frame.removeFromParent();
    this.drawn.delete(key);
  }

  private drawOctomap({ octomap }: SceneContents, { rendering, coloring }: SceneLook): string {
    const look = `${rendering} ${coloring}`;
    if (octomap === this.octomapOf && look === this.voxelLook) return "";
    this.octomapOf = octomap;
    this.voxelLook = look;
    this.voxels?.removeFromParent();
    this.voxels?.dispose();
    this.voxels = null;
    if (octomap === null) return "";
    const voxels = readOctomap(octomap.octomap);
    if (typeof voxels === "string") return voxels;
    this.voxels = voxelBoxes(voxels, { rendering, coloring });
    super.add(placed(this.voxels, octomap.origin));
    return "";
  }
}

function colored(own: ColorRGBA | undefined, otherwise: Rgb, alpha: number): readonly [number, number, number, number] {
  if (own === undefined) return [otherwise[0] / 255, otherwise[1] / 255, otherwise[2] / 255, alpha];
  return [own.r, own.g, own.b, own.a * alpha];
}
