/** A frame of the TF display: its row of properties, its place and its age. */

import { Object3D, Vector3 } from "three";

import { looksSame, type Transform } from "../../frames/transform";
import type { Label, SceneView } from "../../scene/scene_view";
import { BoolProperty, GroupProperty, ReadOut, type Yaml } from "../../rviz/properties";

export class FrameRow extends BoolProperty {
  readonly parent = this.add(new ReadOut("Parent"));
  readonly position = this.add(new ReadOut("Position"));
  readonly orientation = this.add(new ReadOut("Orientation"));
  readonly age = this.add(new ReadOut("Age"));
  readonly publisher = this.add(new ReadOut("Publisher"));
}

/** The tree of frames, nested; the file's copy is left as it is. */
export class TreeProperty extends GroupProperty {
  private drawn = "";

  override save(): undefined {
    return undefined;
  }
  override load(_yaml: Yaml): string[] {
    return [];
  }

  /** Show children by their parents; does nothing if the tree is unchanged. */
  draw(parents: ReadonlyMap<string, string | null>): void {
    const key = [...parents].map((pair) => pair.join("<")).join();
    if (key === this.drawn) return;
    this.drawn = key;
    for (const child of [...this.children]) this.remove(child);
    const rows = new Map([...parents.keys()].map((name) => [name, new GroupProperty(name)]));
    for (const [name, row] of rows) {
      const parent = rows.get(parents.get(name) ?? "");
      if (parent === row) continue;
      (parent ?? this).add(row);
    }
  }
}

/** Fading of an old frame: unchanged for a third of the timeout, then grey, then transparent. */
export interface Fade {
  /** Ratio of grey: 0: full color, 1: grey. */
  readonly grey: number;
  readonly alpha: number;
}

const FRESH: Fade = { grey: 0, alpha: 1 };

export function fadeOf(age: number, timeout: number): Fade {
  const third = timeout / 3;
  if (age <= third) return FRESH;
  if (age <= 2 * third) return { grey: (age - third) / third, alpha: 1 };
  return { grey: 1, alpha: Math.max(0, (timeout - age) / third) };
}

/** Distance in front of a frame, per size of its axes, within which a surface counts as the frame's own robot. */
const REACH = 1.5;

/** Name of a frame without its robot's prefix. */
function shortName(name: string): string {
  return name.slice(name.lastIndexOf("/") + 1) || name;
}

/** Frame in the scene. */
export class FrameView {
  /** Anchor of its name, in the fixed frame. */
  readonly anchor = new Object3D();
  readonly toParent = new Vector3();
  parent: string | null = null;
  /** Number of frames above it. */
  depth = 0;
  isPlaced = false;
  fade: Fade = FRESH;
  private label: Label | null = null;
  private stamp = 0n;
  private changedAt = 0n;

  constructor(
    readonly name: string,
    readonly row: FrameRow,
    private readonly scene: SceneView,
  ) {
    this.anchor.name = name;
  }

  /** Set the pose in the fixed frame; true: it moved visibly. */
  place(pose: Transform): boolean {
    const { position, quaternion } = this.anchor;
    if (this.isPlaced && looksSame(position, quaternion, pose)) return false;
    position.copy(pose.position);
    quaternion.copy(pose.orientation);
    this.isPlaced = true;
    return true;
  }

  get isShown(): boolean {
    return this.isPlaced && this.row.value.peek() && this.fade.alpha > 0;
  }

  /** Set the newest common stamp with the fixed frame, 0 if all is static; returns seconds since it last changed. */
  setStamp(stamp: bigint, now: bigint): number {
    if (stamp !== this.stamp || stamp === 0n || this.changedAt === 0n || now < this.changedAt) {
      this.stamp = stamp;
      this.changedAt = now;
    }
    return Number(now - this.changedAt) * 1e-9;
  }

  /** Set its parent and fading; true: they changed. */
  setKin(parent: string | null, fade: Fade): boolean {
    const changed = parent !== this.parent || fade.grey !== this.fade.grey || fade.alpha !== this.fade.alpha;
    this.parent = parent;
    this.fade = fade;
    return changed;
  }

  /** Label the frame while it is shown; `isNamed`: not only while it is hovered; `size`: of its axes [m]. */
  setLabel(isShown: boolean, isNamed: boolean, size: number): void {
    if (isShown !== (this.label !== null)) {
      this.label?.remove();
      this.label = isShown ? this.scene.addLabel(this.anchor, shortName(this.name)) : null;
    }
    if (this.label === null) return;
    this.label.full = this.name;
    this.label.rank = this.depth;
    this.label.isQuiet = !isNamed;
    this.label.reach = REACH * size;
    this.label.detail = this.parent === null ? "" : `in ${shortName(this.parent)}`;
  }

  dispose(): void {
    this.setLabel(false, false, 0);
    this.anchor.removeFromParent();
  }
}
