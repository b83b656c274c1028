/** rviz's views: the current one, which moves the camera, and the saved ones. */

import { computed, effect, signal, type ReadonlySignal } from "@preact/signals";
import { Box3, OrthographicCamera, PerspectiveCamera, Sphere, Vector3 } from "three";

import { FIXED_FRAME, isMapping, type Triple, type Yaml, type YamlMapping } from "../../rviz/properties";
import type { Transform } from "../../frames/transform";
import { freeArea, type Area } from "../free_area";
import type { CameraInfo } from "../simulated_world";
import type { ThreeScene } from "../three_scene";
import type { SixSides, ViewController, Views } from "../view_controller";
import { CameraMotion, SmoothPose } from "./camera_motion";
import { Fps } from "./fps";
import { FrameAligned } from "./frame_aligned";
import { Orbit } from "./orbit";
import { SensorCamera } from "./sensor_camera";
import { ThirdPersonFollower } from "./third_person_follower";
import { TopDownOrtho } from "./top_down_ortho";
import { ORIGIN, type Motion, type Picture, View } from "./view";
import { XYOrbit } from "./xy_orbit";

const CLASSES: Readonly<Record<string, new () => View>> = {
  "rviz/Orbit": Orbit,
  "rviz/FPS": Fps,
  "rviz/FrameAligned": FrameAligned,
  "rviz/ThirdPersonFollower": ThirdPersonFollower,
  "rviz/TopDownOrtho": TopDownOrtho,
  "rviz/XYOrbit": XYOrbit,
};
/** Smallest radius that is framed [m]. */
const SMALLEST = 0.1;

/** What views need of the scene. */
export type ViewScene = Pick<ThreeScene, "camera" | "size" | "freeArea" | "onTick" | "onSide" | "invalidate">;

export class ViewList implements Views {
  readonly classes = Object.keys(CLASSES);
  readonly saved = signal<readonly ViewController[]>([]);
  private readonly view = signal<View>(new Orbit());
  private readonly smooth = new SmoothPose();
  private readonly perspective = new PerspectiveCamera();
  private readonly orthographic = new OrthographicCamera();
  private readonly before = new Float64Array(16);
  /** Saved views of other classes, kept as they were. */
  private unknown: readonly YamlMapping[] = [];
  private motion: CameraMotion | null = null;
  private readonly stops: (() => void)[];

  /** `targetPose`: pose of a frame or body (`model::link`) in the fixed frame; null: there is none. */
  constructor(
    private readonly scene: ViewScene,
    private readonly targetPose: (target: string) => Transform | null,
  ) {
    let frame = this.view.peek().targetFrame.value.peek();
    let view = this.view.peek();
    this.stops = [
      scene.onTick((elapsed) => this.tick(elapsed)),
      effect(() => {
        const [oldFrame, oldView] = [frame, view];
        view = this.view.value;
        frame = view.targetFrame.value.value;
        if (view === oldView && frame !== oldFrame) this.onTarget(view, oldFrame, frame);
      }),
    ];
    scene.onSide = (side) => this.lookFrom(side);
  }

  readonly cameraFrame: ReadonlySignal<Area | null> = computed(() => {
    const view = this.view.value;
    const { width, height } = this.scene.size.value;
    return view instanceof SensorCamera ? view.rectangle({ width, height, free: freeArea(width, height, this.scene.freeArea.value) }) : null;
  });

  get current(): ReadonlySignal<View> {
    return this.view;
  }

  dispose(): void {
    for (const stop of this.stops) stop();
  }

  /** The picture as views are asked for it. */
  get picture(): Picture {
    const { width, height } = this.scene.size.peek();
    return { width, height, free: freeArea(width, height, this.scene.freeArea.peek()) };
  }

  /** Stop a smooth move, since a person moves the camera. */
  interrupt(): void {
    this.motion = null;
  }

  use(className: string): void {
    const view = create(className);
    if (view === null) return;
    const old = this.view.peek();
    view.targetFrame.value.value = old.targetFrame.value.peek();
    view.mimic(old.eye(this.target), old.focus(this.target), this.target);
    this.show(view);
  }

  useSaved(saved: ViewController): void {
    this.show(copyOf(saved, "Current View"));
  }

  copyCurrent(name: string): ViewController {
    return copyOf(this.view.peek(), name);
  }

  frame(box: Box3): void {
    if (box.isEmpty()) return;
    const { center, radius } = box.getBoundingSphere(new Sphere());
    this.move(this.view.peek().frame(center, Math.max(SMALLEST, radius), this.target, this.picture));
  }

  focus(point: Vector3): void {
    this.move(this.view.peek().frame(point, 0, this.target, this.picture));
  }

  lookFrom(side: SixSides): void {
    if (this.view.peek().lookFrom(side) === null) this.use("rviz/Orbit");
    this.move(this.view.peek().lookFrom(side) ?? []);
  }

  toggleProjection(): void {
    if (!(this.view.peek() instanceof Orbit)) this.use("rviz/Orbit");
    const view = this.view.peek();
    if (view instanceof Orbit) view.projection.toggle();
  }

  lookThrough(camera: CameraInfo, link: string): void {
    this.show(SensorCamera.of(camera, link));
  }

  ride(target: string, from: Triple): void {
    const view = new FrameAligned();
    view.targetFrame.value.value = target;
    view.position.value.value = from;
    for (const angle of [view.roll, view.pitch, view.yaw]) angle.value.value = 0;
    this.show(view);
  }

  follow(target: string | null): void {
    const view = this.view.peek();
    view.targetFrame.value.value = target ?? FIXED_FRAME;
    if (target !== null) this.move(view.centre());
  }

  save(): YamlMapping {
    const saved = [...this.saved.peek().map((view) => view.save()), ...this.unknown];
    return { Current: this.view.value.save(), Saved: saved.length === 0 ? null : saved };
  }

  load(yaml: YamlMapping): string[] {
    const faults: string[] = [];
    const current = loadView(yaml["Current"], faults);
    if (current !== null) this.show(current);
    const saved = Array.isArray(yaml["Saved"]) ? yaml["Saved"].filter((entry: Yaml) => isMapping(entry)) : [];
    this.unknown = saved.filter((entry) => create(classOf(entry)) === null);
    this.saved.value = saved.flatMap((entry) => (this.unknown.includes(entry) ? [] : (loadView(entry, faults) ?? [])));
    return [...faults, ...this.unknown.map((entry) => `Views: there is no view ${classOf(entry)}`)];
  }

  /** Pose of the target frame in the fixed frame. */
  get target(): Transform {
    return this.smooth;
  }

  private resolve(frame: string): Transform | null {
    return frame === FIXED_FRAME || frame === "" ? ORIGIN : this.targetPose(frame);
  }

  private show(view: View): void {
    this.motion = null;
    this.view.value = view;
    const target = this.resolve(view.targetFrame.value.peek());
    if (target !== null) this.smooth.set(target);
  }

  private move(motions: readonly Motion[]): void {
    const isReduced = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.motion = new CameraMotion(motions, isReduced ? 0 : undefined);
  }

  private onTarget(view: View, from: string, to: string): void {
    const target = this.resolve(to);
    if (target === null) return;
    view.shift(this.resolve(from) ?? this.smooth, target);
    this.smooth.set(target);
  }

  private tick(elapsed: number): void {
    if (this.motion?.advance(elapsed) === true) this.motion = null;
    const view = this.view.peek();
    const target = this.resolve(view.targetFrame.value.peek());
    if (target !== null) this.smooth.follow(target, elapsed);
    const camera = view.kind === "perspective" ? this.perspective : this.orthographic;
    view.place(camera, this.smooth, this.picture);
    camera.updateMatrix();
    if (camera !== this.scene.camera.peek()) this.scene.camera.value = camera;
    if (this.hasChanged(camera)) this.scene.invalidate();
  }

  private hasChanged(camera: PerspectiveCamera | OrthographicCamera): boolean {
    const lens = "fov" in camera ? camera.fov : camera.top;
    let changed = false;
    for (let i = 0; i < 16; i += 1) {
      const value = i === 15 ? lens : (camera.matrix.elements[i] ?? 0);
      if (this.before[i] !== value) changed = true;
      this.before[i] = value;
    }
    return changed;
  }
}

/** A view of rviz's or ROS 2's class name; null: unknown. */
function create(className: string): View | null {
  const [, short = className] = className.split("/");
  const found = CLASSES[`rviz/${short}`];
  return found === undefined ? null : new found();
}

function copyOf(view: ViewController, name: string): View {
  const copy = create(view.className) ?? new Orbit();
  copy.load(view.save());
  copy.name.value = name;
  return copy;
}

/** Class of a view of a file; old files have it in `Value`: "Orbit (rviz)". */
function classOf(yaml: YamlMapping): string {
  if (typeof yaml["Class"] === "string") return yaml["Class"];
  return typeof yaml["Value"] === "string" ? `rviz/${yaml["Value"].split(" ")[0] ?? ""}` : "rviz/Orbit";
}

function loadView(yaml: Yaml | undefined, faults: string[]): View | null {
  if (!isMapping(yaml)) return null;
  const className = classOf(yaml);
  const view = create(className);
  if (view === null) faults.push(`Views: there is no view ${className}; Orbit is used`);
  const shown = view ?? new Orbit();
  faults.push(...shown.load(yaml).map((fault) => `Views: ${fault}`));
  return shown;
}
