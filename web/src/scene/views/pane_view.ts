/** The view of one pane: rviz's view controller, its smooth moves, and the frame that it follows. */

import { computed, effect, signal, type ReadonlySignal } from "@preact/signals";
import { OrthographicCamera, PerspectiveCamera, Sphere, type Box3, type Vector3 } from "three";

import { FIXED_FRAME, type Triple, type YamlMapping } from "../../rviz/properties";
import type { Transform } from "../../frames/transform";
import type { Area } from "../free_area";
import type { Pane } from "../panes/pane";
import type { PaneArea } from "../panes/pane_layout";
import type { SixSides, ViewPane } from "../view_controller";
import { CameraMotion, SmoothPose } from "./camera_motion";
import { FrameAligned } from "./frame_aligned";
import { Orbit } from "./orbit";
import { SensorCamera } from "./sensor_camera";
import { ORIGIN, type Motion, type Picture, type View } from "./view";
import { createView, loadView } from "./view_classes";

/** Smallest radius that is framed [m]. */
const SMALLEST = 0.1;

export class PaneView implements ViewPane {
  readonly view;
  readonly place: ReadonlySignal<PaneArea>;
  readonly free: ReadonlySignal<Area>;
  readonly isChosen = signal(false);
  /** Size and free area of the picture. */
  readonly size = computed<Picture>(() => {
    const { width, height } = this.pane.place.value.area;
    return { width, height, free: this.pane.free.value };
  });
  readonly cameraFrame: ReadonlySignal<Area | null> = computed(() => {
    const view = this.view.value;
    return view instanceof SensorCamera ? view.rectangle(this.size.value) : null;
  });
  private readonly smooth = new SmoothPose();
  private readonly perspective = new PerspectiveCamera();
  private readonly orthographic = new OrthographicCamera();
  private readonly before = new Float64Array(16);
  private motion: CameraMotion | null = null;
  /** True while the view changes by itself. */
  private isMoving = false;
  private readonly stops: readonly (() => void)[];

  /** `targetPose`: pose of a frame or body (`model::link`) in the fixed frame; null: there is none. */
  constructor(
    readonly pane: Pane,
    first: View,
    private readonly targetPose: (target: string) => Transform | null,
    private readonly invalidate: () => void,
  ) {
    this.place = pane.place;
    this.free = pane.free;
    this.view = signal(first);
    this.show(first);
    let view = first;
    let frame = first.targetFrame.value.peek();
    this.stops = [
      effect(() => {
        const [oldFrame, oldView] = [frame, view];
        view = this.view.value;
        frame = view.targetFrame.value.value;
        if (view === oldView && frame !== oldFrame) this.onTarget(view, oldFrame, frame);
      }),
      this.noteChoice(),
    ];
  }

  dispose(): void {
    for (const stop of this.stops) stop();
  }

  get current(): ReadonlySignal<View> {
    return this.view;
  }

  get picture(): Picture {
    return this.size.peek();
  }

  /** Pose of the target frame in the fixed frame. */
  get target(): Transform {
    return this.smooth;
  }

  /** Stop a smooth move, since a person moves the camera. */
  interrupt(): void {
    this.motion = null;
  }

  use(className: string): void {
    const view = createView(className);
    if (view === null) return;
    const old = this.view.peek();
    view.targetFrame.value.value = old.targetFrame.value.peek();
    view.mimic(old.eye(this.target), old.focus(this.target), this.target);
    this.show(view);
  }

  show(view: View): void {
    this.motion = null;
    this.view.value = view;
    const target = this.resolve(view.targetFrame.value.peek());
    if (target !== null) this.smooth.set(target);
  }

  load(yaml: YamlMapping): string[] {
    const faults: string[] = [];
    const view = loadView(yaml, faults);
    if (view !== null) this.show(view);
    return faults;
  }

  frame(box: Box3): void {
    if (!box.isEmpty()) this.isChosen.value = true;
    this.moveTo(box);
  }

  frameFirst(box: Box3): void {
    if (!this.isChosen.peek()) this.moveTo(box);
  }

  focus(point: Vector3): void {
    this.isChosen.value = true;
    this.move(this.view.peek().frame(point, 0, this.target, this.picture));
  }

  lookFrom(side: SixSides): void {
    this.isChosen.value = true;
    if (this.view.peek().lookFrom(side) === null) this.use("rviz/Orbit");
    this.move(this.view.peek().lookFrom(side) ?? []);
  }

  toggleProjection(): void {
    if (!(this.view.peek() instanceof Orbit)) this.use("rviz/Orbit");
    const view = this.view.peek();
    if (view instanceof Orbit) view.projection.toggle();
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

  tick(elapsed: number): void {
    this.isMoving = true;
    if (this.motion?.advance(elapsed) === true) this.motion = null;
    this.isMoving = false;
    const view = this.view.peek();
    const target = this.resolve(view.targetFrame.value.peek());
    if (target !== null) this.smooth.follow(target, elapsed);
    const camera = view.kind === "perspective" ? this.perspective : this.orthographic;
    view.place(camera, this.smooth, this.picture);
    camera.updateMatrix();
    const isOther = camera !== this.pane.camera.peek();
    if (isOther) this.pane.camera.value = camera;
    if (this.hasChanged(camera) || isOther) this.invalidate();
  }

  private resolve(frame: string): Transform | null {
    return frame === FIXED_FRAME || frame === "" ? ORIGIN : this.targetPose(frame);
  }

  /** Note that a view was chosen when it is another one, or its properties change. */
  private noteChoice(): () => void {
    let isFirst = true;
    return effect(() => {
      for (const { value } of this.view.value.properties) value.value; // eslint-disable-line @typescript-eslint/no-unused-expressions -- changes with each of them
      if (!isFirst && !this.isMoving) this.isChosen.value = true;
      isFirst = false;
    });
  }

  private moveTo(box: Box3): void {
    if (box.isEmpty()) return;
    const { center, radius } = box.getBoundingSphere(new Sphere());
    this.move(this.view.peek().frame(center, Math.max(SMALLEST, radius), this.target, this.picture));
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
