/** Clouds that a display shows: the newest, or those of the decay time; rviz's PointCloudCommon. */

import type { Group } from "three";

import type { Transform } from "../../frames/transform";
import type { SceneView, Selectable } from "../../scene/scene_view";
import type { Cloud } from "./cloud";
import { describePoint, dress, offerTransformers } from "./cloud_look";
import type { Style } from "./cloud_material";
import type { CloudProperties } from "./cloud_properties";
import { pointsWithin } from "./pick_point";
import { cloudObject, type CloudObject } from "./point_cloud_object";

interface Entry {
  readonly cloud: Cloud;
  readonly transform: Transform;
  /** ROS time [ns]. */
  readonly received: bigint;
  style: Style;
  object: CloudObject;
}

export class PointCloudCommon {
  /** Oldest first. */
  private entries: Entry[] = [];
  private autoSize = false;

  constructor(
    private readonly properties: CloudProperties,
    private readonly root: Group,
    private readonly scene: SceneView,
  ) {}

  /** Points and messages that are shown, as rviz counts them. */
  get status(): string {
    const points = this.entries.reduce((sum, { cloud }) => sum + cloud.count, 0);
    return `Showing [${points}] points from [${this.entries.length}] messages`;
  }

  /** Size grows with the depth of a point, z [m] in its frame. */
  setAutoSize(autoSize: boolean): void {
    this.autoSize = autoSize;
    for (const { object } of this.entries) object.material.uniforms.autoSize.value = autoSize ? 1 : 0;
  }

  add(cloud: Cloud, transform: Transform, received: bigint): void {
    if (this.properties.decay.value.peek() <= 0) this.clear();
    offerTransformers(this.properties, cloud);
    const style = this.properties.style.value.peek() as Style;
    const entry: Entry = { cloud, transform, received, style, object: cloudObject(cloud, style) };
    this.entries.push(entry);
    this.place(entry);
  }

  /** Drop clouds older than the decay time; `now` is ROS time [ns]. */
  update(now: bigint): void {
    const decay = this.properties.decay.value.peek();
    const newest = this.entries.at(-1);
    const isCurrent = (entry: Entry): boolean =>
      decay > 0 ? Number(now - entry.received) * 1e-9 < decay : entry === newest;
    const old = this.entries.filter((entry) => !isCurrent(entry));
    if (old.length === 0) return;
    for (const entry of old) this.erase(entry);
    this.entries = this.entries.filter(isCurrent);
    this.scene.invalidate();
  }

  clear(): void {
    for (const entry of this.entries) this.erase(entry);
    this.entries = [];
    this.scene.invalidate();
  }

  /** Draw with the current properties. */
  restyle(): void {
    const style = this.properties.style.value.peek() as Style;
    for (const entry of this.entries) {
      if (entry.style === style) {
        this.dress(entry);
        continue;
      }
      this.erase(entry);
      entry.style = style;
      entry.object = cloudObject(entry.cloud, style);
      this.place(entry);
    }
    this.scene.invalidate();
  }

  private place(entry: Entry): void {
    const { object } = entry.object;
    object.position.copy(entry.transform.position);
    object.quaternion.copy(entry.transform.orientation);
    this.dress(entry);
    this.root.add(object);
    this.scene.invalidate();
  }

  private dress(entry: Entry): void {
    const { cloud, object, transform } = entry;
    dress(object, cloud, transform, this.properties);
    object.material.uniforms.autoSize.value = this.autoSize ? 1 : 0;
    const selectable: Selectable = {
      describe: (index) => (index === null ? {} : describePoint(cloud, index)),
      indicesIn: (contains) => pointsWithin(cloud, object.object.matrixWorld, contains),
    };
    object.object.userData["selectable"] = selectable;
    object.object.userData["notPicked"] = !this.properties.selectable.value.peek();
  }

  private erase({ object }: Entry): void {
    this.root.remove(object.object);
    object.dispose();
  }
}
