/** Base of rviz's views. */

import { signal } from "@preact/signals";
import { Quaternion, Vector3, type OrthographicCamera, type PerspectiveCamera } from "three";

import type { Transform } from "../../frames/transform";
import {
  FIXED_FRAME,
  FrameProperty,
  NumberProperty,
  type Property,
  type Triple,
  type VectorProperty,
  type Yaml,
  type YamlMapping,
} from "../../rviz/properties";
import type { Area } from "../free_area";
import type { SixSides, ViewController } from "../view_controller";

/** The picture that a view is asked for. */
export interface Picture {
  readonly width: number;
  readonly height: number;
  /** The part that no panel covers [px]. */
  readonly free: Area;
}

/** A property and the value to which it moves. */
export type Motion =
  | { readonly property: NumberProperty; readonly to: number; readonly kind: "length" | "angle" | "scale" }
  | { readonly property: VectorProperty; readonly to: Triple };

export const ORIGIN: Transform = { position: new Vector3(), orientation: new Quaternion() };

/** Smallest near distance as a share of the distance at which the view looks, for the depth's precision. */
const NEAR_SHARE = 5e-4;
const FAR = 2000;

export abstract class View implements ViewController {
  /** rviz's class: `rviz/Orbit`. */
  abstract readonly className: string;
  readonly name = signal("Current View");
  readonly properties: Property<unknown>[] = [];
  readonly targetFrame = this.add(
    new FrameProperty("Target Frame", FIXED_FRAME, { description: "Frame that the view follows" }),
  );
  readonly nearClip = this.add(new NumberProperty("Near Clip Distance", 0.01, { min: 0.001, max: 10, unit: "m" }));
  /** Keys of the file that the page does not know, saved unchanged. */
  private unknown: YamlMapping = {};

  abstract readonly kind: "perspective" | "orthographic";

  /** Set the camera's pose and lens; the target's pose is in the fixed frame. */
  abstract place(camera: PerspectiveCamera | OrthographicCamera, target: Transform, picture: Picture): void;
  /** Rotate by a drag [px]. */
  abstract rotate(dx: number, dy: number): void;
  /** Shift by a drag [px] that ends at a point of the picture. */
  abstract pan(dx: number, dy: number, picture: Picture): void;
  /** Zoom in (factor < 1) or out. */
  abstract zoom(factor: number): void;
  /** Shift along z by a drag with Shift and the right button, if the view can. */
  raise(_dy: number): void {
    // most views have only one way to zoom
  }

  /** Motions after which a sphere of the fixed frame fills the free part; radius 0: its centre is centered. */
  abstract frame(centre: Vector3, radius: number, target: Transform, picture: Picture): Motion[];
  /** Motions to a view from a side; null: unsupported by this view. */
  abstract lookFrom(side: SixSides): Motion[] | null;
  /** Start with another view's camera: at `eye`, looking at `focus`, in the fixed frame. */
  abstract mimic(eye: Vector3, focus: Vector3, target: Transform): void;
  /** Focal point in the fixed frame. */
  abstract focus(target: Transform): Vector3;
  /** Camera's position in the fixed frame; without perspective, one with about the same picture. */
  abstract eye(target: Transform): Vector3;
  /** Motions that bring the target into the middle. */
  abstract centre(): Motion[];

  /** Keep the picture when the target changes. */
  shift(from: Transform, to: Transform): void {
    this.mimic(this.eye(from), this.focus(from), to);
  }

  protected add<P extends Property<unknown>>(property: P): P {
    this.properties.push(property);
    return property;
  }

  save(): YamlMapping {
    const saved: Record<string, Yaml> = { ...this.unknown, Class: this.className, Name: this.name.value };
    for (const property of this.properties) {
      const yaml = property.save();
      if (yaml !== undefined) saved[property.name] = yaml;
    }
    return saved;
  }

  load(yaml: YamlMapping): string[] {
    const known = new Map(this.properties.map((property) => [property.name, property]));
    const faults: string[] = [];
    const unknown: Record<string, Yaml> = {};
    for (const [key, value] of Object.entries(yaml)) {
      const property = known.get(key);
      if (property !== undefined) faults.push(...property.load(value));
      else if (key === "Name" && typeof value === "string") this.name.value = value;
      else if (key !== "Class") unknown[key] = value;
    }
    this.unknown = unknown;
    return faults;
  }

  /** Near and far planes for a view that looks at something at a distance [m]. */
  protected setRange(camera: PerspectiveCamera | OrthographicCamera, distance: number): void {
    camera.near = Math.max(this.nearClip.value.peek(), distance * NEAR_SHARE);
    camera.far = Math.max(FAR, distance * 4);
  }
}

/** Directions in which one looks from a side, as yaw and pitch of the eye around the focal point [rad]. */
export const SIDES: Readonly<Record<SixSides, readonly [number, number]>> = {
  front: [0, 0],
  back: [Math.PI, 0],
  left: [Math.PI / 2, 0],
  right: [-Math.PI / 2, 0],
  top: [-Math.PI / 2, Math.PI / 2],
  bottom: [-Math.PI / 2, -Math.PI / 2],
};

export function triple(vector: Vector3): Triple {
  return [vector.x, vector.y, vector.z];
}

/** The angle that differs by full turns and lies in −π…π. */
export function wrapAngle(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
