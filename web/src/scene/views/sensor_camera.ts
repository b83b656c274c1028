/** View through a simulated camera, by its pose on its link and its field of view; a person cannot move the view. */

import { PerspectiveCamera, type OrthographicCamera } from "three";

import type { CameraInfo } from "../../protocol/generated/page_messages";
import { NumberProperty, type YamlMapping } from "../../rviz/properties";
import type { Transform } from "../../frames/transform";
import type { Area } from "../free_area";
import { FrameAligned } from "./frame_aligned";
import type { Motion, Picture } from "./view";

/** Widest angle that a picture without distortion has [rad]. */
const WIDEST = 2.8;
const LARGEST = 1e5; // px
const FIELD_OF_VIEW = "Horizontal Field of View";

export class SensorCamera extends FrameAligned {
  override readonly className: string = "trundle/Camera";
  private readonly width = this.add(new NumberProperty("Width", 320, { min: 1, max: LARGEST, unit: "px" }));
  private readonly height = this.add(new NumberProperty("Height", 240, { min: 1, max: LARGEST, unit: "px" }));
  private readonly horizontal = this.add(
    new NumberProperty(FIELD_OF_VIEW, 1, { min: 0.001, max: WIDEST, unit: "rad" }),
  );

  /** True if a saved view was a camera's. */
  static isSavedIn(yaml: YamlMapping): boolean {
    return yaml["Class"] === "rviz/FrameAligned" && FIELD_OF_VIEW in yaml;
  }

  /** Look through a camera on a link, `model::link`. */
  static of(camera: CameraInfo, link: string): SensorCamera {
    const view = new SensorCamera();
    const [x, y, z, roll, pitch, yaw] = camera.pose;
    view.targetFrame.value.value = link;
    view.position.value.value = [x, y, z];
    view.roll.value.value = roll;
    view.pitch.value.value = pitch;
    view.yaw.value.value = yaw;
    view.width.value.value = camera.width;
    view.height.value.value = camera.height;
    view.horizontal.value.value = Math.min(WIDEST, camera.horizontal_fov);
    view.nearClip.value.value = camera.near;
    return view;
  }

  /** The rectangle of the picture [px] that the camera's own picture is. */
  rectangle({ free }: Picture): Area {
    const aspect = this.width.value.value / this.height.value.value;
    const width = Math.min(free.width, free.height * aspect);
    const height = width / aspect;
    return { left: free.left + (free.width - width) / 2, top: free.top + (free.height - height) / 2, width, height };
  }

  override place(camera: PerspectiveCamera | OrthographicCamera, target: Transform, picture: Picture): void {
    super.place(camera, target, picture);
    if (!(camera instanceof PerspectiveCamera)) return;
    const focal = this.rectangle(picture).width / 2 / Math.tan(this.horizontal.value.peek() / 2);
    camera.fov = (Math.atan(picture.height / 2 / focal) * 360) / Math.PI;
  }

  /** Save a FrameAligned, which rviz knows, with further properties from which the page restores the camera. */
  override save(): YamlMapping {
    const halfHeight =
      (Math.tan(this.horizontal.value.peek() / 2) * this.height.value.peek()) / this.width.value.peek();
    return { ...super.save(), Class: "rviz/FrameAligned", "Field of View": 2 * Math.atan(halfHeight) };
  }

  override rotate(): void {
    // the link alone moves it
  }

  override pan(): void {
    // the link alone moves it
  }

  override zoom(): void {
    // the link alone moves it
  }

  override frame(): Motion[] {
    return [];
  }

  override centre(): Motion[] {
    return [];
  }
}
