/** rviz/Camera: pictures of a topic with the scene drawn over them. */

import { signal, untracked } from "@preact/signals";
import type { WebGLRenderer } from "three";

import { NoTransform, type Transform } from "../frames/transform";
import type { Received, Subscription } from "../protocol/connection";
import type { CameraInfo } from "../protocol/generated/ros_messages";
import { nanoseconds } from "../protocol/ros_types";
import { calibratedSize, cameraPose, pictureRectangle, projection } from "./cameras/camera_projection";
import { cameraInfoTopic } from "./cameras/depth_points";
import { ScenePicture } from "./cameras/scene_picture";
import { VisibilityProperty } from "./cameras/visibility";
import { PictureDisplay } from "./pictures/picture_display";
import type { Picture } from "./pictures/picture_stream";
import { EnumProperty, NumberProperty } from "../rviz/properties";
import { register } from "./registry";
import { readValues } from "./watch";

const BACKGROUND = "background";
const OVERLAY = "overlay";
const BOTH = "background and overlay";
const INFO = "sensor_msgs/CameraInfo";
/** Largest picture that the scene is drawn for [pixels]. */
const MAX_PIXELS = 4096 * 4096;

class CameraDisplay extends PictureDisplay {
  readonly className = "rviz/Camera";
  readonly rendering = this.add(
    new EnumProperty("Image Rendering", BOTH, [BACKGROUND, OVERLAY, BOTH], {
      description: "Image behind the scene, over it, or both.",
    }),
  );
  readonly alpha = this.add(new NumberProperty("Overlay Alpha", 0.5, { min: 0, max: 1 }));
  readonly zoom = this.add(new NumberProperty("Zoom Factor", 1, { min: 0.00001, max: 100000 }));
  private readonly visibility = this.add(new VisibilityProperty());
  readonly picture = signal<Picture | null>(null);

  private readonly info = signal<CameraInfo | null>(null);
  private scenePicture: ScenePicture | null = null;
  private canvas: HTMLCanvasElement | null = null;
  private subscription: Subscription | null = null;
  private removeStep = (): void => undefined;
  /** True while an image waits for its transform. */
  private isStale = false;
  private transformAtImage: Transform | null = null;

  protected override onStart(): void {
    super.onStart();
    this.scenePicture = new ScenePicture();
    this.canvas = document.createElement("canvas");
    this.removeStep = this.context.scene.addStep({ after: (renderer) => this.drawScene(renderer) });
    this.whileEnabled(() => {
      const topic = this.topicProperty.value.value;
      untracked(() => this.follow(topic));
    });
    this.whileEnabled(() => {
      const isAvailable = this.stream.value?.picture.value != null && this.info.value !== null;
      this.isStale = isAvailable;
      this.transformAtImage = null;
      if (!isAvailable) this.picture.value = null;
    });
    this.whileEnabled(() => this.visibility.follow(this.context.displays.value));
    this.whileEnabled(() => {
      readValues([this.rendering, this.alpha, this.zoom, this.visibility]);
      this.context.scene.invalidate();
    });
  }

  protected override onStop(): void {
    super.onStop();
    this.follow("");
    this.removeStep();
    this.scenePicture?.dispose();
    this.scenePicture = null;
    this.picture.value = null;
  }

  private follow(topic: string): void {
    this.subscription?.close();
    this.subscription = null;
    this.info.value = null;
    if (topic === "") return;
    const infoTopic = this.context.names.resolve(cameraInfoTopic(topic));
    this.setStatus("Camera Info", "warn", `No CameraInfo received on [${infoTopic}].\nTopic may not exist.`);
    this.subscription = this.context.connection.subscribe<CameraInfo>(
      infoTopic,
      (received) => this.receiveInfo(received),
      {
        onError: (text) => this.setStatus("Camera Info", "error", text),
      },
    );
  }

  private receiveInfo({ type, message }: Received<CameraInfo>): void {
    if (type !== INFO) this.setStatus("Camera Info", "error", `of type ${type}, not ${INFO}`);
    else this.info.value = message;
  }

  override update(now: bigint, elapsed: number): void {
    super.update(now, elapsed);
    const image = this.stream.peek()?.picture.peek() ?? null;
    if (!this.isStale || image === null) return;
    const { frame_id, stamp } = image.header;
    const transform = this.context.frames.lookup(this.context.fixedFrame.peek(), frame_id, nanoseconds(stamp));
    if (transform instanceof NoTransform) this.setStatus("Transform", "error", transform.text, transform.advice);
    else {
      this.transformAtImage = transform;
      this.isStale = false;
      this.setStatus("Transform", "ok", "Transform OK");
      this.context.scene.invalidate();
    }
  }

  /** Draw the scene over the newest image. */
  private drawScene(renderer: WebGLRenderer): void {
    const image = this.stream.peek()?.picture.peek() ?? null;
    const info = this.info.peek();
    const transform = this.transformAtImage;
    if (image === null || info === null || transform === null) return;
    this.compareFrames(image, info);
    const size = calibratedSize(info, image);
    const matrix = projection(info, size, this.zoom.value.peek());
    if (typeof matrix === "string" || size.width * size.height > MAX_PIXELS) {
      this.setStatus(
        "Camera Info",
        "error",
        typeof matrix === "string" ? matrix : `An image of ${size.width} x ${size.height} is too large`,
      );
      return;
    }
    this.setStatus("Camera Info", "ok", "processed");
    const { scene, displays } = this.context;
    this.scenePicture?.draw(
      renderer,
      scene.displays,
      size,
      matrix,
      cameraPose(info, transform),
      this.visibility.hidden(displays.peek()),
    );
    this.compose(image, info, size);
  }

  /** Draw the image behind the scene, over it, or both. */
  private compose(image: Picture, info: CameraInfo, size: { readonly width: number; readonly height: number }): void {
    const { canvas, scenePicture } = this;
    const context = canvas?.getContext("2d") ?? null;
    if (canvas === null || context === null || scenePicture === null) return;
    if (canvas.width !== size.width || canvas.height !== size.height) Object.assign(canvas, size);
    const rectangle = pictureRectangle(info, size, this.zoom.value.peek());
    const rendering = this.rendering.value.peek();
    context.globalAlpha = 1;
    context.clearRect(0, 0, size.width, size.height);
    if (rendering !== OVERLAY) context.drawImage(image.image, ...rectangle);
    context.drawImage(scenePicture.canvas, 0, 0);
    context.globalAlpha = this.alpha.value.peek();
    if (rendering !== BACKGROUND) context.drawImage(image.image, ...rectangle);
    this.picture.value = { image: canvas, ...size, header: image.header };
  }

  private compareFrames(image: Picture, info: CameraInfo): void {
    const [imageFrame, infoFrame] = [image.header.frame_id, info.header.frame_id];
    if (imageFrame === infoFrame) this.clearStatus("Image frame");
    else this.setStatus("Image frame", "warn", `Image frame (${imageFrame}) doesn't match camera frame (${infoFrame})`);
  }
}

register({ className: "rviz/Camera", aliases: [], types: [], create: (context) => new CameraDisplay(context) });
