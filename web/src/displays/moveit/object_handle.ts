/** Handles at the object of a planning scene that a person moves. */

import type { CollisionObject, Pose } from "../../protocol/generated/ros_messages";
import type { Rgb } from "../../rviz/properties";
import { LocalMarker, type LocalMarkerParts } from "./local_marker";
import { atPose, type DraftChanges, type SceneDraft } from "./scene_draft";

const COLOR: Rgb = [63, 190, 208];

export type HandleParts = Pick<LocalMarkerParts, "context" | "root" | "frame" | "anchor">;

export class ObjectHandle {
  private marker: LocalMarker | null = null;
  private object: CollisionObject | null = null;
  private before: DraftChanges | null = null;

  constructor(private readonly draft: SceneDraft) {}

  /** Show the handles at an object, or none. */
  show(object: CollisionObject | null, parts: HandleParts | null): void {
    const isSame = object !== null && this.object?.id === object.id && this.marker !== null;
    this.object = object;
    if (isSame) this.marker?.place(object.pose);
    else {
      this.marker?.dispose();
      this.marker = object === null || parts === null ? null : this.make(object, parts);
    }
  }

  update(elapsed: number): void {
    this.marker?.update(elapsed);
  }

  private make({ id, pose }: CollisionObject, parts: HandleParts): LocalMarker {
    return new LocalMarker({
      ...parts,
      name: `object ${id}`,
      pose,
      size: 0,
      color: COLOR,
      onDrag: (dragged) => this.drag(dragged),
      onRelease: () => this.release(),
    });
  }

  private drag(pose: Pose): void {
    if (this.object === null) return;
    this.before ??= this.draft.changes.peek();
    this.draft.changes.value = this.draft.withObject(this.object.id, atPose(this.object, pose));
  }

  private release(): void {
    const { before, object } = this;
    this.before = null;
    if (before !== null && object !== null) this.draft.record(`Move ${object.id}`, before, this.draft.changes.peek());
  }
}
