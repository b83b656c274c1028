/** Base of displays whose messages become clouds. */

import { untracked } from "@preact/signals";

import type { Transform } from "../../frames/transform";
import type { DisplayContext } from "../display";
import { TopicDisplay, type Stamped } from "../topic_display";
import type { Cloud } from "./cloud";
import { CloudProperties, type FixedChannel } from "./cloud_properties";
import { PointCloudCommon } from "./point_cloud_common";

interface Fresh<M> {
  readonly message: M;
  readonly transform: Transform;
  readonly end: Transform;
  readonly received: bigint;
}

export abstract class CloudDisplay<M extends Stamped> extends TopicDisplay<M> {
  readonly cloudProperties: CloudProperties;
  private readonly common: PointCloudCommon;
  /** Messages since the last frame, oldest first. */
  private fresh: Fresh<M>[] = [];

  constructor(context: DisplayContext, types: readonly string[], fixed?: FixedChannel) {
    super(context, types);
    this.cloudProperties = new CloudProperties(fixed);
    this.properties.push(...this.cloudProperties.all);
    this.common = new PointCloudCommon(this.cloudProperties, this.root, context.scene);
  }

  /** The points of a message in its frame, or the reason why there are none. */
  protected abstract read(message: M, transform: Transform, end: Transform): Cloud | string;

  /** Pose of the points in the fixed frame. */
  protected pose(transform: Transform): Transform {
    return transform;
  }

  protected override onStart(): void {
    super.onStart();
    this.whileEnabled(() => {
      this.cloudProperties.track();
      untracked(() => this.common.restyle());
    });
  }

  protected process(message: M, transform: Transform, end: Transform): void {
    const received = this.context.connection.now();
    const decay = this.cloudProperties.decay.value.peek();
    this.fresh = this.fresh.filter((earlier) => Number(received - earlier.received) * 1e-9 < decay);
    this.fresh.push({ message, transform, end, received });
  }

  protected clear(): void {
    this.fresh = [];
    this.common.clear();
    this.clearStatus("Message");
    this.clearStatus("Points");
  }

  /** Read points once per frame, so that a fast sensor costs no more than the frames drawn. */
  override update(now: bigint, elapsed: number): void {
    super.update(now, elapsed);
    const { fresh } = this;
    this.fresh = [];
    for (const one of fresh) this.guard(() => this.show(one));
    this.common.update(now);
    if (fresh.length > 0) this.setStatus("Points", "ok", this.common.status);
  }

  private show({ message, transform, end, received }: Fresh<M>): void {
    const cloud = this.read(message, transform, end);
    if (typeof cloud === "string") {
      this.setStatus("Message", "error", cloud);
      return;
    }
    this.clearStatus("Message");
    this.common.add(cloud, this.pose(transform), received);
  }
}
