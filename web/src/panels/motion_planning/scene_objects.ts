/** Objects of a planning scene as a person changes them in the panel: added, moved, attached, published. */

import { Euler, Matrix4, Object3D, Quaternion, Vector3 } from "three";

import type { MotionPlanningDisplay } from "../../displays/motion_planning";
import { Primitive } from "../../displays/moveit/object_shapes";
import { poseOf } from "../../displays/moveit/robot_state";
import { atPose, scaled } from "../../displays/moveit/scene_draft";
import { placed } from "../../frames/valid";
import type { AttachedCollisionObject, CollisionObject, Pose } from "../../protocol/generated/ros_messages";

import { saveFile, sentence } from "../use";
import { importMesh } from "./mesh_import";
import type { MotionPlanningState } from "./motion_planning_state";
import { collisionObject, readScene, writeScene } from "./scene_file";

export type ShapeName = "box" | "sphere" | "cylinder" | "cone";

/** Sizes of new shapes [m]: sides, radius, or length and radius. */
const SIZES: Readonly<Record<ShapeName, readonly number[]>> = {
  box: [0.2, 0.2, 0.2],
  sphere: [0.1],
  cylinder: [0.2, 0.1],
  cone: [0.2, 0.1],
};
/** Place of a new object: in front of the robot, as rviz has it, above the ground [m]. */
const NEW: Pose = { position: { x: 0.5, y: 0, z: 0.3 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
const NO_POSTURE = { header: { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "" }, joint_names: [], points: [] };

/** Roll, pitch, yaw about fixed axes [rad] of an orientation. */
export function rpyOf({ orientation: { x, y, z, w } }: Pose): readonly [number, number, number] {
  const euler = new Euler().setFromQuaternion(new Quaternion(x, y, z, w), "ZYX");
  return [euler.x, euler.y, euler.z];
}

export class SceneObjects {
  constructor(
    private readonly state: MotionPlanningState,
    private readonly display: MotionPlanningDisplay,
  ) {
    display.draft.history = state.page.undo;
  }

  addShape(shape: ShapeName): void {
    const primitives = [{ type: Primitive[shape], dimensions: Float64Array.from(SIZES[shape]) }];
    this.add(collisionObject(this.freeId(shape), this.frame, NEW, { primitives }));
  }

  /** Add a mesh of a file, or of an address (package://, file://). */
  async addMesh(uri: string, bytes?: ArrayBuffer): Promise<void> {
    const { connection } = this.state.page;
    try {
      const fetch = (asset: string): Promise<ArrayBuffer> =>
        bytes !== undefined && asset === uri ? Promise.resolve(bytes) : connection.fetchAsset(asset);
      const mesh = await importMesh(uri, fetch);
      const name = uri.slice(uri.lastIndexOf("/") + 1).replace(/\.\w+$/, "");
      this.add(collisionObject(this.freeId(name || "mesh"), this.frame, NEW, { meshes: [mesh] }));
    } catch (error) {
      this.fail(`${uri}: ${sentence(error)}`);
    }
  }

  remove(id: string): void {
    const { draft } = this.display;
    draft.edit(`Remove ${id}`, draft.withObject(id, null));
    if (draft.selected.peek() === id) draft.selected.value = null;
  }

  /** Set one of x, y, z [m], roll, pitch, yaw [rad]. */
  place(object: CollisionObject, part: number, value: number): void {
    const { x, y, z } = object.pose.position;
    const values = [x, y, z, ...rpyOf(object.pose)].map((old, index) => (index === part ? value : old));
    const [px = 0, py = 0, pz = 0, roll = 0, pitch = 0, yaw = 0] = values;
    const turn = new Quaternion().setFromEuler(new Euler(roll, pitch, yaw, "ZYX"));
    const orientation = { x: turn.x, y: turn.y, z: turn.z, w: turn.w };
    this.change(`Move ${object.id}`, atPose(object, { position: { x: px, y: py, z: pz }, orientation }));
  }

  scale(object: CollisionObject, factor: number): void {
    this.change(`Scale ${object.id}`, scaled(object, factor));
  }

  /** Set a size of a primitive [m]. */
  resize(object: CollisionObject, shape: number, dimension: number, value: number): void {
    const primitives = object.primitives.map((solid, index) =>
      index === shape
        ? { ...solid, dimensions: solid.dimensions.map((old, at) => (at === dimension ? value : old)) }
        : solid,
    );
    this.change(`Change of ${object.id}`, { ...object, primitives });
  }

  /** Give an object to a link, which carries it. */
  attach(object: CollisionObject, link: string): void {
    const { draft } = this.display;
    const effector = this.display.group.peek()?.effectorLinks ?? new Set<string>();
    const body: AttachedCollisionObject = {
      link_name: link,
      object: this.relative(object, link),
      touch_links: [...new Set([link, ...effector])],
      detach_posture: NO_POSTURE,
      weight: 0,
    };
    draft.edit(`Attach ${object.id}`, draft.withAttached(object.id, body));
    draft.selected.value = null;
  }

  detach({ object, link_name }: AttachedCollisionObject): void {
    const { draft } = this.display;
    const frame = object.header.frame_id || link_name;
    const link = this.linkPose(frame);
    const pose = poseOf(link.multiply(matrixOf(object.pose)));
    const free = { ...atPose(object, pose), header: { ...object.header, frame_id: this.frame } };
    draft.edit(`Detach ${object.id}`, draft.withDetached(object.id, free));
  }

  /** Send the changes to move_group. */
  async publish(): Promise<void> {
    const { draft } = this.display;
    const { connection } = this.state.page;
    const service = this.state.serviceName("apply_planning_scene");
    const scene = draft.message();
    try {
      if (connection.services.peek().has(service)) {
        const answer = await connection.callService(service, { scene });
        if (answer["success"] !== true) throw new Error("move_group refused the scene");
      } else connection.publish(this.state.serviceName("planning_scene"), "moveit_msgs/PlanningScene", scene);
      draft.clear();
      this.state.outcome.value = { isDone: true, text: "The scene is published." };
    } catch (error) {
      this.fail(`${service}: ${sentence(error)}`);
    }
  }

  /** Download the scene as NAME.scene. */
  exportFile(): void {
    const { drafted } = this.display;
    const { name, objects, colors } = drafted.peek();
    const file = writeScene({ name: name || "(noname)", objects: [...objects.values()], colors });
    saveFile(`${name.replace(/[^\w-]+/g, "") || "planning"}.scene`, new Blob([file], { type: "text/plain" }));
  }

  importFile(name: string, text: string): void {
    const { draft } = this.display;
    try {
      const { objects } = readScene(text, this.frame);
      const changed = new Map(draft.changes.peek().objects);
      for (const object of objects) changed.set(object.id, object);
      draft.edit(`Import ${name}`, { ...draft.changes.peek(), objects: changed });
    } catch (error) {
      this.fail(`${name}: ${sentence(error)}`);
    }
  }

  private add(object: CollisionObject): void {
    const { draft } = this.display;
    draft.edit(`Add ${object.id}`, draft.withObject(object.id, object));
    draft.selected.value = object.id;
  }

  private change(title: string, object: CollisionObject): void {
    const { draft } = this.display;
    draft.edit(title, draft.withObject(object.id, object));
  }

  private get frame(): string {
    return this.display.model?.frame ?? "";
  }

  private relative(object: CollisionObject, link: string): CollisionObject {
    const inLink = this.linkPose(link).invert().multiply(matrixOf(object.pose));
    return { ...atPose(object, poseOf(inLink)), header: { ...object.header, frame_id: link } };
  }

  /** Pose of a link of the robot as it is, in the model's frame. */
  private linkPose(link: string): Matrix4 {
    const { model, current, currentRoot } = this.display;
    return model?.forward(current.peek(), currentRoot).get(link) ?? new Matrix4();
  }

  private freeId(name: string): string {
    const { objects, attached } = this.display.drafted.peek();
    const isFree = (id: string): boolean => !objects.has(id) && !attached.has(id);
    if (isFree(name)) return name;
    let number = 2;
    while (!isFree(`${name}_${number}`)) number += 1;
    return `${name}_${number}`;
  }

  private fail(text: string): void {
    this.state.outcome.value = { isDone: false, text };
  }
}

function matrixOf(pose: Pose): Matrix4 {
  const object = placed(new Object3D(), pose);
  return new Matrix4().compose(object.position, object.quaternion, new Vector3(1, 1, 1));
}
