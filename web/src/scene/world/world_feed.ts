/** The simulated world as the server's channels describe it, drawn in the scene. */

import { batch, computed, effect, signal, untracked, type ReadonlySignal } from "@preact/signals";
import { Box3, Matrix4, Vector3, type Mesh, type Object3D } from "three";

import type { ClockState, Manifest, ReferenceInfo } from "../../protocol/generated/page_messages";
import type { DrawnFrames } from "../../frames/frame_tree";
import type { Transform } from "../../frames/transform";
import type { Connection } from "../../protocol/connection";
import { ShownParts } from "../overlays/shown_parts";
import type { JointStates, Reference, SimulatedWorld } from "../simulated_world";
import type { ThreeScene } from "../three_scene";
import { BodyPoses } from "./body_poses";
import { GhostShapes } from "./ghost_shapes";
import type { GlbModel } from "./glb_model";
import { readJoints } from "./joint_states";
import { WorldPlacement } from "./placement";
import { Sky } from "./sky";
import { WorldCollisions } from "./world_collisions";
import { WorldFiles } from "./world_files";
import { readLines, WorldLines } from "./world_lines";
import { WorldLighting } from "./world_lighting";
import { WorldReference } from "./world_reference";

export class WorldFeed implements SimulatedWorld {
  readonly manifest = signal<Manifest | null>(null);
  readonly state = signal<ClockState | null>(null);
  readonly joints: ReadonlySignal<JointStates>;
  readonly shown = new ShownParts();
  readonly hidden = signal<ReadonlySet<string>>(new Set());
  readonly isDrawn = signal(false);
  readonly ghostShapes = new GhostShapes();
  readonly referenceInfo = computed(() => this.manifest.value?.reference ?? this.bag.value);
  /** Bag that the topics are compared with. */
  private readonly bag = signal<ReferenceInfo | null>(null);
  /** True once the first world is loaded; before, the grid is hidden, since a grid alone means an empty world. */
  private readonly hasLoaded = signal(false);
  private readonly lighting = new WorldLighting();
  private readonly files: WorldFiles;
  private readonly poses = new BodyPoses();
  private readonly placement: WorldPlacement;
  private readonly sky = new Sky();
  private readonly lines = new WorldLines();
  private readonly compared: WorldReference;
  private readonly poseListeners = new Set<(time: number) => void>();
  private readonly stops: (() => void)[] = [];
  private readonly collisions: WorldCollisions;

  constructor(
    private readonly connection: Connection,
    private readonly scene: ThreeScene,
    frames: DrawnFrames,
    private readonly fixedFrame: ReadonlySignal<string>,
  ) {
    this.files = new WorldFiles(scene.world, this.lighting, (added, removed) => this.onFiles(added, removed));
    this.placement = new WorldPlacement(scene.world, this.poses, frames);
    this.collisions = new WorldCollisions(this.files, () => this.showParts());
    this.joints = this.listenToJoints();
    this.compared = new WorldReference(
      scene,
      frames,
      (body) => this.object(body),
      this.ghostShapes,
      (error) => this.files.fault("The recording to compare with", error),
    );
    this.sky.visible = false;
    scene.world.add(this.sky, this.lines);
    this.listen();
  }

  get progress(): ReadonlySignal<number> {
    return this.files.progress;
  }

  get faults(): ReadonlySignal<readonly string[]> {
    return this.files.faults;
  }

  get reference(): ReadonlySignal<Reference | null> {
    return this.compared.current;
  }

  onPoses(call: (time: number) => void): () => void {
    this.poseListeners.add(call);
    return () => this.poseListeners.delete(call);
  }

  pose(body: number): Transform | null {
    return this.poses.pose(body);
  }

  object(body: number): Object3D | null {
    return this.poses.object(body);
  }

  bounds(bodies: readonly number[]): Box3 {
    const box = new Box3();
    this.scene.world.updateWorldMatrix(true, true);
    for (const body of bodies) {
      const object = this.object(body);
      if (object !== null) box.union(new Box3().setFromObject(object));
    }
    return box;
  }

  referenceBounds(model: string | null): Box3 {
    return this.compared.bounds(model);
  }

  extent(bodies: readonly number[], of: number): Box3 {
    const box = new Box3();
    this.scene.world.updateWorldMatrix(true, true);
    const toAxes = this.object(of)?.matrixWorld.clone().invert();
    for (const body of toAxes === undefined ? [] : bodies) {
      this.object(body)?.traverseVisible((object) => addVertices(box, object, toAxes));
    }
    return box;
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    this.files.show([]);
    this.compared.dispose();
    this.scene.world.remove(this.sky, this.lines);
  }

  private listen(): void {
    const { connection, scene } = this;
    const on = (topic: string, act: (payload: DataView) => void): void => {
      const subscription = connection.subscribeRaw(topic, act);
      this.stops.push(() => subscription.close());
    };
    const subscriptions = [
      connection.subscribeJson("trundle/world", (manifest) => batch(() => this.onManifest(manifest))),
      connection.subscribeJson("trundle/state", (state) => {
        this.state.value = state;
      }),
      connection.subscribeJson("trundle/reference", (bag) => {
        this.bag.value = bag;
      }),
    ];
    this.stops.push(...subscriptions.map((subscription) => () => subscription.close()));
    on("trundle/poses", (payload) => this.takePoses(payload));
    on("trundle/lines", (payload) => {
      const lines = readLines(payload);
      if (lines === null || (lines.length === 0 && this.lines.children.length === 0)) return;
      this.lines.show(lines);
      scene.invalidate();
    });
    this.stops.push(
      scene.addStep({ before: (renderer) => this.lighting.update(renderer, scene.scene) }),
      scene.onTick(() => this.place()),
      effect(() => {
        this.hide(this.hidden.value);
      }),
      this.followLoading(),
      effect(() => {
        const url = this.manifest.value?.collisions ?? null;
        this.collisions.load(this.shown.any("collisions") ? url : null);
      }),
      this.shown.all.subscribe(() => this.showParts()),
      this.shown.models.subscribe(() => this.showParts()),
      effect(() => {
        const manifest = this.manifest.value;
        const isGrid = this.shown.world.value.get("grid") ?? manifest?.scene.grid ?? false;
        if (manifest !== null) scene.grid.value = isGrid && this.hasLoaded.value;
      }),
      effect(() => {
        const info = this.referenceInfo.value;
        untracked(() => this.compared.setInfo(info));
      }),
      effect(() => {
        const { current } = this.compared;
        if (this.ghostShapes.revision.value >= 0 && current.value !== null) untracked(() => this.buildGhost());
      }),
      effect(() => {
        if (connection.state.value.kind === "connected") return;
        this.poses.forgetPoses(); // a new connection sends all poses again
      }),
    );
  }

  /** Note when all files are loaded, and then that a picture shows them. */
  private followLoading(): () => void {
    const isLoaded = computed(() => this.manifest.value !== null && this.progress.value === 1);
    return effect(() => {
      this.isDrawn.value = false;
      if (!isLoaded.value) return;
      this.hasLoaded.value = true;
      let isBegun = false; // the next shown picture may have been drawn before
      const stop = this.scene.addStep({
        before: () => {
          isBegun = true;
        },
        after: () => {
          if (!isBegun) return;
          stop();
          this.isDrawn.value = true;
        },
      });
      return stop;
    });
  }

  /** Joints are asked for only while something listens. */
  private listenToJoints(): ReadonlySignal<JointStates> {
    let stop: (() => void) | null = null;
    const joints = signal<JointStates>([], {
      watched: () => {
        const subscription = this.connection.subscribeRaw("trundle/joints", (payload) => {
          const read = readJoints(payload, this.manifest.peek()?.generation ?? -1);
          if (read !== null) joints.value = read;
        });
        stop = () => subscription.close();
      },
      unwatched: () => {
        stop?.();
      },
    });
    return joints;
  }

  private onManifest(manifest: Manifest): void {
    const before = this.manifest.peek();
    if (before !== null && before.name !== manifest.name) this.poses.forgetPoses();
    this.manifest.value = manifest;
    const { scene } = manifest;
    this.lighting.setScene(scene);
    const background = scene.background.map((part) => Math.round(255 * part));
    this.scene.background.value = `rgb(${background.join(", ")})`;
    this.sky.visible = scene.sky;
    this.files.show([
      ...manifest.files.filter(({ id }) => id !== manifest.draft?.original),
      ...(manifest.draft?.files ?? []),
    ]);
    this.lighting.setContents(this.scene.world, scene.shadows);
    this.scene.invalidate();
  }

  private takePoses(payload: DataView): void {
    const manifest = this.manifest.peek();
    if (manifest === null || !this.poses.apply(payload, manifest.generation)) return;
    this.placement.remember(manifest);
    const hasGhostMoved = this.synchronize();
    for (const call of this.poseListeners) call(Number(this.poses.time) / 1e9);
    if (this.poses.takeMoved() || hasGhostMoved) this.redraw();
  }

  private onFiles(added: GlbModel | null, removed: GlbModel | null): void {
    for (const [body, object] of added?.bodies ?? []) this.poses.attach(body, object);
    for (const object of removed?.bodies.values() ?? []) this.poses.detach(object);
    this.hide(this.hidden.peek());
    untracked(() => this.showParts());
    this.buildGhost();
    this.lighting.setContents(this.scene.world, this.manifest.peek()?.scene.shadows ?? false);
    this.scene.invalidate();
  }

  private place(): void {
    const manifest = this.manifest.peek();
    if (manifest === null) {
      if (this.showGhost()) this.scene.invalidate();
      return;
    }
    const hasGhostMoved = this.synchronize();
    const isPlaced = this.placement.update(manifest, this.fixedFrame.peek());
    this.placement.moveFrames(manifest, this.fixedFrame.peek(), this.state.peek()?.paused ?? true);
    if (this.poses.takeMoved() || hasGhostMoved || isPlaced) this.redraw();
  }

  /** Draw bodies, frames and the ghost at one time; true: the ghost has moved. */
  private synchronize(): boolean {
    this.placement.synchronize(this.fixedFrame.peek(), this.state.peek()?.paused ?? true);
    return this.showGhost();
  }

  /** Show the ghost at the time that is drawn; true: it has moved. */
  private showGhost(): boolean {
    const fixedFrame = this.fixedFrame.peek();
    const isWorld = this.manifest.peek() !== null;
    const time = isWorld ? Number(this.poses.drawnAt) / 1e9 : this.compared.graphTime(fixedFrame);
    return time !== null && this.compared.show(time, fixedFrame);
  }

  private buildGhost(): void {
    this.compared.rebuild(this.manifest.peek());
    this.showGhost();
    this.compared.hide((link) => isHidden(link, this.hidden.peek()));
  }

  private redraw(): void {
    this.lighting.invalidate();
    this.scene.invalidate();
  }

  private hide(hidden: ReadonlySet<string>): void {
    this.scene.world.traverse((object) => {
      if (typeof object.userData["body"] === "number")
        object.visible = !isHidden(String(object.userData["name"]), hidden);
    });
    this.compared.hide((link) => isHidden(link, hidden));
    this.lighting.invalidate();
    this.scene.invalidate();
  }

  /** Show the visuals and collisions of each model by its shown parts. */
  private showParts(): void {
    const { shown } = this;
    for (const model of this.files.models) {
      model.show((name) => ({
        visuals: shown.of("visuals", name),
        transparent: shown.of("transparent", name),
        wireframe: shown.of("wireframe", name),
      }));
    }
    this.collisions.show(
      (body) => this.object(body),
      (model) => shown.of("collisions", model),
    );
    this.lighting.invalidate();
    this.scene.invalidate();
  }
}

function addVertices(box: Box3, object: Object3D, toAxes: Matrix4 | undefined): void {
  const position = (object as Partial<Mesh>).geometry?.getAttribute("position");
  if (position === undefined || toAxes === undefined) return;
  const matrix = new Matrix4().multiplyMatrices(toAxes, object.matrixWorld);
  const point = new Vector3();
  for (let i = 0; i < position.count; i += 1) {
    box.expandByPoint(point.fromBufferAttribute(position, i).applyMatrix4(matrix));
  }
}

/** True if a link's name (`model::link`) or one of the models that it is in is hidden. */
export function isHidden(name: string, hidden: ReadonlySet<string>): boolean {
  const parts = name.split("::");
  return parts.some((_, i) => hidden.has(parts.slice(0, i + 1).join("::")));
}
