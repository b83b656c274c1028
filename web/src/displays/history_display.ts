/** Base of displays that draw each message as an object in its frame and keep the last ones. */

import type { Object3D } from "three";

import type { Transform } from "../frames/transform";
import type { Selectable } from "../scene/scene_view";
import { TopicDisplay, type Stamped } from "./topic_display";
import { watch } from "./watch";

interface Entry<M> {
  readonly message: M;
  readonly transform: Transform;
  object: Object3D | null;
}

export abstract class HistoryDisplay<M extends Stamped> extends TopicDisplay<M> {
  /** Oldest first. */
  private entries: Entry<M>[] = [];

  /** Draw a message in its own frame with the current properties. */
  protected abstract draw(message: M): Object3D;

  /** Pose of the drawn object in the fixed frame. */
  protected pose(transform: Transform): Transform {
    return transform;
  }

  /** Number of messages that are shown at once. */
  protected capacity(): number {
    return 1;
  }

  /** Fields of a picked message. */
  protected describe(_message: M): Readonly<Record<string, unknown>> {
    return {};
  }

  protected process(message: M, transform: Transform): void {
    this.entries.push({ message, transform, object: null });
    this.trim();
  }

  protected override onStart(): void {
    super.onStart();
    this.atStop(watch(this.properties, () => this.redraw()));
  }

  /** Draw messages once per frame, so that fast topics cost no more than the frames drawn. */
  override update(now: bigint, elapsed: number): void {
    super.update(now, elapsed);
    for (const entry of this.entries) if (entry.object === null) this.place(entry);
  }

  protected clear(): void {
    for (const entry of this.entries) this.erase(entry);
    this.entries = [];
  }

  private redraw(): void {
    for (const entry of this.entries) this.erase(entry);
    this.trim();
    this.context.scene.invalidate();
  }

  private trim(): void {
    const excess = this.entries.length - this.capacity();
    if (excess > 0) for (const entry of this.entries.splice(0, excess)) this.erase(entry);
  }

  private place(entry: Entry<M>): void {
    const { message, transform } = entry;
    const object = this.draw(message);
    const { position, orientation } = this.pose(transform);
    object.position.copy(position);
    object.quaternion.copy(orientation);
    const selectable: Selectable = { describe: () => ({ Frame: message.header.frame_id, ...this.describe(message) }) };
    object.userData["selectable"] = selectable;
    entry.object = object;
    this.root.add(object);
    this.context.scene.invalidate();
  }

  private erase(entry: Entry<M>): void {
    if (entry.object === null) return;
    this.root.remove(entry.object);
    dispose(entry.object);
    entry.object = null;
  }
}

/** Free the GPU resources of an object and its descendants by their `dispose`. */
function dispose(object: Object3D): void {
  object.traverse((part) => {
    if ("dispose" in part && typeof part.dispose === "function") (part as { dispose(): void }).dispose();
  });
}
