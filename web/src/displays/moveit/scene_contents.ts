/** Planning scene as its messages describe it: the whole first, then differences. */

import type {
  AttachedCollisionObject,
  CollisionObject,
  ColorRGBA,
  OctomapWithPose,
  PlanningScene,
} from "../../protocol/generated/ros_messages";

/** Operations of collision objects. */
export const Operation = { add: 0, remove: 1, append: 2, move: 3 } as const;

export class SceneContents {
  name = "";
  readonly objects = new Map<string, CollisionObject>();
  readonly attached = new Map<string, AttachedCollisionObject>();
  readonly colors = new Map<string, ColorRGBA>();
  octomap: OctomapWithPose | null = null;

  /** Follow a message; true: objects, attached ones, colors or the octomap may have changed. */
  apply(scene: PlanningScene): boolean {
    const { world, robot_state: state, object_colors: colors } = scene;
    if (!scene.is_diff) this.clear();
    if (scene.name !== "") this.name = scene.name;
    for (const object of world.collision_objects) this.applyObject(object);
    if (!state.is_diff) this.attached.clear();
    for (const body of state.attached_collision_objects) this.applyAttached(body);
    for (const { id, color } of colors) this.colors.set(id, color);
    const { octomap } = world;
    const hasOctomap = octomap.octomap.data.length > 0 || octomap.octomap.id !== "";
    if (hasOctomap) this.octomap = octomap.octomap.data.length > 0 ? octomap : null;
    return (
      !scene.is_diff ||
      !state.is_diff ||
      hasOctomap ||
      world.collision_objects.length + state.attached_collision_objects.length + colors.length > 0
    );
  }

  copy(): SceneContents {
    const copy = new SceneContents();
    copy.name = this.name;
    copy.octomap = this.octomap;
    for (const [id, object] of this.objects) copy.objects.set(id, object);
    for (const [id, body] of this.attached) copy.attached.set(id, body);
    for (const [id, color] of this.colors) copy.colors.set(id, color);
    return copy;
  }

  private clear(): void {
    for (const part of [this.objects, this.attached, this.colors]) part.clear();
    this.octomap = null;
  }

  private applyObject(object: CollisionObject): void {
    const { id, operation } = object;
    const known = this.objects.get(id);
    if (operation === Operation.remove) {
      if (id === "") this.objects.clear();
      else this.objects.delete(id);
    } else if (known !== undefined && operation === Operation.move) this.objects.set(id, moved(known, object));
    else if (known !== undefined && operation === Operation.append) this.objects.set(id, joined(known, object));
    else {
      this.objects.set(id, object);
      this.attached.delete(id); // it was detached
    }
  }

  private applyAttached(body: AttachedCollisionObject): void {
    const { id, operation } = body.object;
    const known = this.objects.get(id);
    if (operation === Operation.remove) {
      if (id === "") this.attached.clear();
      else this.attached.delete(id);
      return;
    }
    // an attached object without shapes of its own is one of the world
    const isNamed = shapeCount(body.object) === 0 && known !== undefined;
    this.attached.set(id, isNamed ? { ...body, object: known } : body);
    this.objects.delete(id);
  }
}

function shapeCount({ primitives, meshes, planes }: CollisionObject): number {
  return primitives.length + meshes.length + planes.length;
}

/** Object whose shapes stay, at other poses: the object's own, or those of the shapes that the message gives. */
function moved(known: CollisionObject, change: CollisionObject): CollisionObject {
  return {
    ...known,
    header: change.header,
    pose: change.pose,
    primitive_poses: change.primitive_poses.length > 0 ? change.primitive_poses : known.primitive_poses,
    mesh_poses: change.mesh_poses.length > 0 ? change.mesh_poses : known.mesh_poses,
    plane_poses: change.plane_poses.length > 0 ? change.plane_poses : known.plane_poses,
  };
}

function joined(known: CollisionObject, more: CollisionObject): CollisionObject {
  return {
    ...known,
    primitives: [...known.primitives, ...more.primitives],
    primitive_poses: [...known.primitive_poses, ...more.primitive_poses],
    meshes: [...known.meshes, ...more.meshes],
    mesh_poses: [...known.mesh_poses, ...more.mesh_poses],
    planes: [...known.planes, ...more.planes],
    plane_poses: [...known.plane_poses, ...more.plane_poses],
  };
}
