/**
 * Place of the simulated world in the fixed frame.
 *
 * A frame that a body carries is in the world and in tf: its pose in the world comes with the bodies' poses, in the
 * fixed frame from tf. Both poses are read at one time, so that the world stands still while the robot moves.
 */

import { Matrix4, Quaternion, Vector3, type Group } from "three";

import type { Manifest } from "../../protocol/generated/page_messages";
import type { DrawnFrames } from "../../frames/frame_tree";
import { NoTransform, type Transform } from "../../frames/transform";
import type { BodyPoses } from "./body_poses";

/** Largest number of poses kept until tf has caught up. */
const MAX_PAST = 64;
/** Largest delay with which the world is drawn to match tf [ns]; frames that tf sends later lag behind the world. */
const MAX_LAG = 250_000_000n;
/** Smaller changes count as rounding errors [m]. */
const STILL = 1e-4;
const ONE = new Vector3(1, 1, 1);

export class WorldPlacement {
  private readonly past: { readonly time: bigint; readonly pose: Transform }[] = [];
  private anchor: Manifest["frames"][number] | null = null;
  private readonly matrix = new Matrix4();
  private readonly other = new Matrix4();

  constructor(
    private readonly group: Group,
    private readonly poses: BodyPoses,
    private readonly frames: DrawnFrames,
  ) {}

  /** Store the anchor's pose at the time of the newest poses. */
  remember(manifest: Manifest): void {
    const anchor = manifest.frames.find(({ body }) => body === manifest.robot) ?? manifest.frames[0] ?? null;
    if (anchor?.frame !== this.anchor?.frame || anchor?.body !== this.anchor?.body) this.past.length = 0;
    this.anchor = anchor;
    const pose = anchor === null ? null : this.poses.pose(anchor.body);
    if (pose === null || this.poses.time === this.past[this.past.length - 1]?.time) return;
    this.past.push({ time: this.poses.time, pose });
    if (this.past.length > MAX_PAST) this.past.shift();
  }

  /**
   * Draw bodies and frames at one time: the newest time that both the poses and tf have.
   * While time stands still, both are drawn as they are now.
   */
  synchronize(fixedFrame: string, isPaused: boolean): void {
    const { poses, frames, anchor } = this;
    const newest = anchor === null || isPaused ? 0n : frames.newestTime(fixedFrame, anchor.frame);
    const isBehind = newest !== 0n && newest < poses.time && poses.time - newest < MAX_LAG;
    const time = isBehind ? newest : poses.time;
    frames.drawnAt = isPaused ? null : time;
    poses.draw(time);
  }

  /** Move the world to its place; true if it moved. */
  update(manifest: Manifest, fixedFrame: string): boolean {
    const matrix = this.find(manifest, fixedFrame.replace(/^\//, ""));
    if (matrix === null) return false;
    const [x = 0, y = 0, z = 0] = [12, 13, 14].map(
      (i) => (matrix.elements[i] ?? 0) - (this.group.matrix.elements[i] ?? 0),
    );
    const turned = [0, 1, 4, 5].some(
      (i) => Math.abs((matrix.elements[i] ?? 0) - (this.group.matrix.elements[i] ?? 0)) > STILL,
    );
    if (Math.hypot(x, y, z) < STILL && !turned) return false;
    matrix.decompose(this.group.position, this.group.quaternion, this.group.scale);
    this.group.updateMatrix();
    return true;
  }

  /** Tell the frames how edits moved the bodies while time stands still, since nothing publishes tf then. */
  moveFrames({ frames }: Manifest, fixedFrame: string, isPaused: boolean): void {
    const name = fixedFrame.replace(/^\//, "");
    const moved = isPaused && frames.some(({ body }) => this.poses.poseBefore(body) !== null);
    this.frames.moved = moved ? { fixedFrame: name, motions: this.motions(frames, name) } : null;
  }

  /** Motions in the fixed frame of the frames that bodies carry. */
  private motions(frames: Manifest["frames"], fixedFrame: string): ReadonlyMap<string, Transform> {
    const inWorld = frames.map(({ frame, body }): readonly [string, Matrix4] => {
      const [before, now] = [this.poses.poseBefore(body), this.poses.pose(body)];
      if (before === null || now === null) return [frame, new Matrix4()];
      return [frame, this.set(new Matrix4(), now).multiply(this.set(this.other, before).invert())];
    });
    const fixed = this.matrix.copy(this.group.matrix);
    const ofFixed = inWorld.find(([frame]) => frame === fixedFrame)?.[1];
    if (ofFixed !== undefined) fixed.multiply(ofFixed); // the world's place in the fixed frame before that frame was moved
    const back = this.other.copy(fixed).invert();
    return new Map(inWorld.map(([frame, motion]) => [frame, poseOf(motion.premultiply(fixed).multiply(back))]));
  }

  private find(manifest: Manifest, fixedFrame: string): Matrix4 | null {
    const carried = manifest.frames.find(({ frame }) => frame === fixedFrame);
    const body = carried === undefined ? null : this.poses.drawn(carried.body);
    if (body !== null) return this.set(this.matrix, body).invert();
    if (this.anchor === null || fixedFrame === "world") return this.matrix.identity();
    for (let i = this.past.length - 1; i >= 0; i -= 1) {
      const past = this.past[i];
      if (past === undefined) break;
      const inFixed = this.frames.lookup(fixedFrame, this.anchor.frame, past.time);
      if (inFixed instanceof NoTransform) continue;
      this.past.splice(0, i); // older poses are not needed any more
      return this.set(this.matrix, inFixed).multiply(this.set(this.other, past.pose).invert());
    }
    return null;
  }

  private set(
    matrix: Matrix4,
    { position, orientation }: { readonly position: Vector3; readonly orientation: Quaternion },
  ): Matrix4 {
    return matrix.compose(position, orientation, ONE);
  }
}

function poseOf(matrix: Matrix4): Transform {
  const pose = { position: new Vector3(), orientation: new Quaternion() };
  matrix.decompose(pose.position, pose.orientation, new Vector3());
  return pose;
}
