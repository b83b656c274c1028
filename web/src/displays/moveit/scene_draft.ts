/** Changes of a planning scene that a person makes and has not published yet. */

import { computed, signal } from "@preact/signals";

import type { AttachedCollisionObject, CollisionObject, Pose } from "../../protocol/generated/ros_messages";
import type { RosMessage } from "../../protocol/ros_types";
import type { UndoStack } from "../undo_stack";
import { Operation, type SceneContents } from "./scene_contents";

/** Changes by id; null: it is removed. */
export interface DraftChanges {
  readonly objects: ReadonlyMap<string, CollisionObject | null>;
  readonly attached: ReadonlyMap<string, AttachedCollisionObject | null>;
}

const NOTHING: DraftChanges = { objects: new Map(), attached: new Map() };

export class SceneDraft {
  readonly changes = signal<DraftChanges>(NOTHING);
  readonly count = computed(() => this.changes.value.objects.size + this.changes.value.attached.size);
  /** Id of the object that a person moves; null: none. */
  readonly selected = signal<string | null>(null);
  /** The page's undo stack; null: changes cannot be undone. */
  history: UndoStack | null = null;

  /** Make a change that can be undone. */
  edit(title: string, after: DraftChanges): void {
    this.record(title, this.changes.peek(), after);
  }

  /** Make a change that can be undone, from an earlier state. */
  record(title: string, before: DraftChanges, after: DraftChanges): void {
    const set = (changes: DraftChanges) => (): void => void (this.changes.value = changes);
    if (this.history === null) set(after)();
    else this.history.run(title, set(after), set(before));
  }

  /** The changes with another object, or without one. */
  withObject(id: string, object: CollisionObject | null): DraftChanges {
    const { objects, attached } = this.changes.peek();
    return { objects: new Map(objects).set(id, object), attached };
  }

  withAttached(id: string, body: AttachedCollisionObject): DraftChanges {
    const { objects, attached } = this.changes.peek();
    return { objects: without(objects, id), attached: new Map(attached).set(id, body) };
  }

  /** The changes with an object that was in the hand and now is where the hand had it. */
  withDetached(id: string, object: CollisionObject): DraftChanges {
    const { objects, attached } = this.changes.peek();
    return { objects: new Map(objects).set(id, object), attached: new Map(attached).set(id, null) };
  }

  /** Change a scene's contents in place; a computation that calls it follows the changes. */
  apply(contents: SceneContents): void {
    const { objects, attached } = this.changes.value;
    for (const [id, body] of attached) {
      if (body === null) contents.attached.delete(id);
      else {
        contents.attached.set(id, body);
        contents.objects.delete(id);
      }
    }
    for (const [id, object] of objects) {
      if (object === null) contents.objects.delete(id);
      else contents.objects.set(id, object);
    }
  }

  /** The changes as a difference of the scene. */
  message(): RosMessage {
    const { objects, attached } = this.changes.peek();
    const world = [...objects].map(([id, object]) =>
      object === null ? { id, operation: Operation.remove } : { ...object, operation: Operation.add },
    );
    const bodies = [...attached].map(([id, body]) =>
      body === null
        ? { object: { id, operation: Operation.remove } }
        : { ...body, object: { ...body.object, operation: Operation.add } },
    );
    return {
      is_diff: true,
      robot_state: { is_diff: true, attached_collision_objects: bodies },
      world: { collision_objects: world },
    };
  }

  clear(): void {
    this.changes.value = NOTHING;
  }
}

function without<T>(map: ReadonlyMap<string, T>, key: string): ReadonlyMap<string, T> {
  const rest = new Map(map);
  rest.delete(key);
  return rest;
}

/** Object at another pose. */
export function atPose(object: CollisionObject, pose: Pose): CollisionObject {
  return { ...object, pose };
}

/** Object whose shapes, and their distances from its origin, are larger by a factor. */
export function scaled(object: CollisionObject, factor: number): CollisionObject {
  const far = (pose: Pose): Pose => {
    const { x, y, z } = pose.position;
    return { ...pose, position: { x: x * factor, y: y * factor, z: z * factor } };
  };
  return {
    ...object,
    primitives: object.primitives.map((shape) => ({
      ...shape,
      dimensions: shape.dimensions.map((size) => size * factor),
    })),
    primitive_poses: object.primitive_poses.map(far),
    meshes: object.meshes.map((mesh) => ({
      ...mesh,
      vertices: mesh.vertices.map(({ x, y, z }) => ({ x: x * factor, y: y * factor, z: z * factor })),
    })),
    mesh_poses: object.mesh_poses.map(far),
  };
}
