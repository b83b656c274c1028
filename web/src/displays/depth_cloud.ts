/** rviz/DepthCloud: points of a depth image, in the colors of another image. */

import { computed, effect, untracked } from "@preact/signals";

import type { NoTransform, Transform } from "../frames/transform";
import type { CameraInfo, Image } from "../protocol/generated/ros_messages";
import type { Received } from "../protocol/connection";
import { nanoseconds } from "../protocol/ros_types";
import { autoSize, cameraInfoTopic, depthPoints } from "./cameras/depth_points";
import { CloudProperties } from "./clouds/cloud_properties";
import { PointCloudCommon } from "./clouds/point_cloud_common";
import { Display, type DisplayContext } from "./display";
import { MessageFilter } from "./message_filter";
import { readPixels } from "./pictures/pixels";
import { BoolProperty, EnumProperty, IntProperty, NumberProperty, TopicProperty } from "../rviz/properties";
import { register } from "./registry";
import { touch } from "./topic_display";

const IMAGE = "sensor_msgs/Image";
const INFO = "sensor_msgs/CameraInfo";
/** Largest difference of the stamps of a pair of images [ns]. */
const MAX_STAMP_DIFFERENCE = 500_000_000n;

export class DepthCloudDisplay extends Display {
  readonly className = "rviz/DepthCloud";
  readonly topicFilter = this.add(
    new BoolProperty("Topic Filter", true, { description: "Kept for rviz, without effect here." }),
  );
  readonly depthTopic = this.add(new TopicProperty("Depth Map Topic", "", [IMAGE]));
  readonly depthTransport = this.add(new EnumProperty("Depth Map Transport Hint", "raw", ["raw"], { open: true }));
  readonly colorTopic = this.add(new TopicProperty("Color Image Topic", "", [IMAGE]));
  readonly colorTransport = this.add(new EnumProperty("Color Transport Hint", "raw", ["raw"], { open: true }));
  readonly queueSize = this.add(
    new IntProperty("Queue Size", 5, { min: 1, description: "Images that wait for transforms and for each other." }),
  );
  readonly useAutoSize = this.add(
    new BoolProperty("Auto Size", true, { description: "Points as wide as a pixel of the camera sees." }),
  );
  readonly autoSizeFactor = this.useAutoSize.add(
    new NumberProperty("Auto Size Factor", 1, { min: 0.0001, visible: computed(() => this.useAutoSize.value.value) }),
  );
  readonly occlusion = this.add(new BoolProperty("Occlusion Compensation", false));
  readonly occlusionTimeout = this.occlusion.add(
    new NumberProperty("Occlusion Time-Out", 30, { unit: "s", visible: computed(() => this.occlusion.value.value) }),
  );
  readonly cloudProperties = new CloudProperties();

  private readonly common: PointCloudCommon;
  private readonly filter: MessageFilter<Image, Transform>;
  private stops: (() => void)[] = [];
  private info: CameraInfo | null = null;
  private ready: { readonly depth: Image; readonly transform: Transform } | null = null;
  private colors: Image[] = [];
  private count = 0;

  constructor(context: DisplayContext) {
    super(context);
    this.properties.push(...this.cloudProperties.all);
    this.common = new PointCloudCommon(this.cloudProperties, this.root, context.scene);
    this.filter = new MessageFilter(
      ({ header }) => context.frames.lookup(context.fixedFrame.peek(), header.frame_id, nanoseconds(header.stamp)),
      (depth, transform) => {
        this.ready = { depth, transform };
        this.setStatus("Transform", "ok", "Transform OK");
      },
      (reason: NoTransform) => this.setStatus("Transform", "error", reason.text, reason.advice),
    );
  }

  override get topic(): string | null {
    return this.context.names.resolve(this.depthTopic.value.value) || null;
  }

  protected onStart(): void {
    const { connection } = this.context;
    const follow = (topic: () => string, type: string, take: (message: never) => void): void => {
      this.stops.push(
        effect(() => {
          const name = this.context.names.resolve(topic());
          if (name === "") return undefined;
          const onMessage = (received: Received<never>): void => {
            if (received.type === type) take(received.message);
            else this.setStatus("Message", "error", `${name} is of type ${received.type}, not ${type}`);
          };
          const subscription = connection.subscribe<never>(name, onMessage, {
            onError: (text) => this.setStatus("Message", "error", text),
          });
          return () => subscription.close();
        }),
      );
    };
    this.stops.push(
      effect(() => {
        [this.context.fixedFrame, this.depthTopic.value, this.colorTopic.value].forEach(touch);
        untracked(() => this.forget());
      }),
      effect(() => this.filter.setLimit(this.queueSize.value.value)),
      effect(() => {
        this.cloudProperties.track();
        untracked(() => this.common.restyle());
      }),
      effect(() => {
        const isAuto = this.useAutoSize.value.value;
        touch(this.autoSizeFactor.value);
        untracked(() => {
          this.common.setAutoSize(isAuto);
          this.fitSize();
        });
      }),
      effect(() => this.nameUnsupported()),
    );
    follow(
      () => this.depthTopic.value.value,
      IMAGE,
      (depth: Image) => this.takeDepth(depth),
    );
    follow(
      () => this.colorTopic.value.value,
      IMAGE,
      (color: Image) => this.takeColor(color),
    );
    follow(
      () => (this.depthTopic.value.value === "" ? "" : cameraInfoTopic(this.depthTopic.value.value)),
      INFO,
      (info: CameraInfo) => {
        this.info = info;
        this.fitSize();
      },
    );
  }

  protected onStop(): void {
    for (const stop of this.stops) stop();
    this.stops = [];
    this.forget();
    this.info = null;
  }

  private forget(): void {
    this.filter.clear();
    this.common.clear();
    this.ready = null;
    this.colors = [];
    this.count = 0;
    for (const name of ["Message", "Transform", "Depth Image Size", "Image Size", "Points"]) this.clearStatus(name);
    this.setStatus(
      "Depth Map",
      "warn",
      "0 depth maps received",
      this.topic === null ? "Choose a depth map topic." : undefined,
    );
  }

  private nameUnsupported(): void {
    const others = [this.depthTransport, this.colorTransport].filter(({ value }) => value.value !== "raw");
    const names = [
      ...others.map(({ name, value }) => `${name} ${value.value}`),
      ...(this.occlusion.value.value ? ["Occlusion Compensation"] : []),
    ];
    untracked(() => {
      if (names.length === 0) this.clearStatus("Unsupported");
      else this.setStatus("Unsupported", "warn", `${names.join(" and ")}: not supported here`);
    });
  }

  private takeDepth(depth: Image): void {
    this.count += 1;
    this.setStatus("Depth Map", "ok", `${this.count} depth maps received`);
    this.filter.add(depth);
  }

  private takeColor(color: Image): void {
    this.colors = [...this.colors, color].slice(-this.queueSize.value.peek());
  }

  private fitSize(): void {
    if (this.useAutoSize.value.peek() && this.info !== null)
      this.cloudProperties.size.value.value = autoSize(this.info, this.autoSizeFactor.value.peek());
  }

  override update(now: bigint, elapsed: number): void {
    this.filter.flush(elapsed);
    const { ready, info } = this;
    if (ready !== null && info === null) this.setStatus("Message", "warn", "Waiting for CameraInfo message..");
    if (ready !== null && info !== null) this.show(ready.depth, ready.transform, info);
    this.common.update(now);
  }

  private show(depth: Image, transform: Transform, info: CameraInfo): void {
    const isColored = this.colorTopic.value.peek() !== "";
    const color = isColored ? this.nearestColor(depth) : null;
    if (isColored && color === null) return; // the color image is yet to come
    this.ready = null;
    const pixels = color === null ? null : readPixels(color, { isAutomatic: true, min: 0, max: 1, window: 1 });
    const cloud = typeof pixels === "string" ? pixels : depthPoints(depth, info, pixels);
    if (typeof cloud === "string") {
      this.setStatus("Message", "error", cloud);
      return;
    }
    this.setStatus("Depth Image Size", "ok", `${depth.width} x ${depth.height}`);
    if (color !== null) this.setStatus("Image Size", "ok", `${color.width} x ${color.height}`);
    const [depthFrame, colorFrame] = [depth.header.frame_id, color?.header.frame_id];
    if (colorFrame === undefined || colorFrame === depthFrame) this.setStatus("Message", "ok", "Ok");
    else
      this.setStatus(
        "Message",
        "warn",
        `Depth image frame id [${depthFrame}] doesn't match color image frame id [${colorFrame}]`,
      );
    this.common.add(cloud, transform, this.context.connection.now());
    this.setStatus("Points", "ok", this.common.status);
  }

  /** Color image nearest in time. */
  private nearestColor({ header }: Image): Image | null {
    let best: Image | null = null;
    let minDistance = MAX_STAMP_DIFFERENCE;
    for (const color of this.colors) {
      const apart = nanoseconds(color.header.stamp) - nanoseconds(header.stamp);
      const distance = apart < 0n ? -apart : apart;
      if (distance <= minDistance) [best, minDistance] = [color, distance];
    }
    return best;
  }
}

register({ className: "rviz/DepthCloud", aliases: [], types: [], create: (context) => new DepthCloudDisplay(context) });
