/** The recording that the page compares with: fetched when it is named, and shown as a ghost. */

import { signal } from "@preact/signals";
import { Box3, Quaternion, Vector3, type Object3D } from "three";

import type { DrawnFrames } from "../../frames/frame_tree";
import { NoTransform } from "../../frames/transform";
import type { Manifest, ReferenceInfo } from "../../protocol/generated/page_messages";
import type { Reference } from "../simulated_world";
import type { ThreeScene } from "../three_scene";
import type { GhostShapes } from "./ghost_shapes";
import { fetchBytes } from "./glb_model";
import { ReferenceGhost, type ShapesOf } from "./reference_ghost";
import { ReferenceMotion } from "./reference_motion";

const NO_SHAPES: readonly Object3D[] = [];

export class WorldReference {
  /** Null: nothing is compared, or it is not loaded yet. */
  readonly current = signal<Reference | null>(null);
  private info: ReferenceInfo | null = null;
  private readonly ghost: ReferenceGhost;
  private abort = new AbortController();
  /** Time since the recording's start that the ghost shows [s]; null: none. */
  private shownAt: number | null = null;
  private readonly removeStep: () => void;
  private readonly position = new Vector3();
  private readonly orientation = new Quaternion();

  /** `objectOf`: returns the loaded object of a body; `onFault`: called if the recording cannot be loaded. */
  constructor(
    private readonly scene: ThreeScene,
    private readonly frames: DrawnFrames,
    private readonly objectOf: (body: number) => Object3D | null,
    private readonly shapes: GhostShapes,
    private readonly onFault: (error: unknown) => void,
  ) {
    this.ghost = new ReferenceGhost(scene);
    this.removeStep = scene.addStep({ before: () => this.current.peek() !== null && this.ghost.setColor() });
  }

  /** Follow the server's description of the recording; null: there is none. */
  setInfo(info: ReferenceInfo | null): void {
    const { info: former } = this;
    this.info = info;
    if (info === null || info.url !== former?.url) {
      this.abort.abort();
      this.current.value = null;
      this.ghost.clear();
      if (info !== null) void this.load(info);
      this.scene.invalidate();
      return;
    }
    const loaded = this.current.peek();
    if (loaded !== null) this.current.value = { ...loaded, info };
  }

  /** Copy the shapes again, after they came or went. */
  rebuild(manifest: Manifest | null): void {
    const loaded = this.current.peek();
    if (loaded === null) return;
    this.shownAt = null;
    this.ghost.build(loaded.info, this.shapesOf(loaded.info, manifest));
    this.scene.invalidate();
  }

  /** Show the ghost at a time of the world or graph [s]; true: it has moved. */
  show(time: number, fixedFrame: string): boolean {
    const loaded = this.current.peek();
    if (loaded === null) return false;
    const since = time - loaded.info.start;
    const isMoved = since !== this.shownAt;
    if (isMoved) this.ghost.show(loaded.motion, since);
    this.shownAt = since;
    return (loaded.info.root !== "" && this.placeRoot(loaded, fixedFrame, since)) || isMoved;
  }

  /** Time of the graph's newest transforms of a recorded frame [s], at which robots are drawn; null: there is none. */
  graphTime(fixedFrame: string): number | null {
    const { links = [] } = this.current.peek()?.info ?? {};
    for (const frame of links) {
      const time = this.frames.newestTime(fixedFrame, frame);
      if (time > 0n) return Number(time) / 1e9;
    }
    return null;
  }

  /** Extent of the ghost of a model, or null: of all, in the fixed frame; empty: none is shown. */
  bounds(model: string | null): Box3 {
    if (this.shownAt === null) return new Box3();
    return this.ghost.bounds((link) => model === null || link.startsWith(`${model}::`));
  }

  hide(isHidden: (link: string) => boolean): void {
    this.ghost.hide(isHidden);
  }

  dispose(): void {
    this.abort.abort();
    this.removeStep();
    this.ghost.dispose();
  }

  /** Place the root frame of a bag: by the graph's transforms, or by the recorded pose of the fixed frame. */
  private placeRoot({ info, motion }: Reference, fixedFrame: string, since: number): boolean {
    const { position, orientation } = this;
    position.set(0, 0, 0);
    orientation.identity();
    const pose = info.root === fixedFrame ? null : this.frames.lookup(fixedFrame, info.root, 0n);
    const recorded = info.links.indexOf(fixedFrame);
    if (pose instanceof NoTransform && recorded >= 0) {
      motion.pose(recorded, since, position, orientation);
      orientation.conjugate();
      position.negate().applyQuaternion(orientation);
    } else if (pose !== null && !(pose instanceof NoTransform)) {
      position.copy(pose.position);
      orientation.copy(pose.orientation);
    }
    return this.ghost.place(position, orientation);
  }

  /** Visuals of the world's links; of a bag, also robots' links by their frames. */
  private shapesOf({ root }: ReferenceInfo, manifest: Manifest | null): ShapesOf {
    const bodies = manifest === null ? new Map<string, number>() : bodiesByLink(manifest, root !== "");
    return (link) => {
      const body = bodies.get(link);
      const object = body === undefined ? null : this.objectOf(body);
      if (object !== null) return object.children.filter((child) => child.userData["visual"] !== undefined);
      const shape = root === "" ? null : this.shapes.find(link);
      return shape === null ? NO_SHAPES : [shape];
    };
  }

  private async load(info: ReferenceInfo): Promise<void> {
    const abort = new AbortController();
    this.abort = abort;
    try {
      const data = await fetchBytes(new URL(info.url, document.baseURI).href, () => undefined, abort.signal);
      if (abort.signal.aborted) return;
      this.current.value = { info: this.info ?? info, motion: new ReferenceMotion(info, data) };
    } catch (error) {
      if (!abort.signal.aborted) this.onFault(error);
    }
  }
}

/**
 * Bodies by `model::link`, in which a nested model's link is `model::nested::link`; `byFrame`: by the link's own name,
 * as its frame has, of the first model that has it.
 */
function bodiesByLink({ models }: Pick<Manifest, "models">, byFrame: boolean): ReadonlyMap<string, number> {
  const bodies = new Map<string, number>();
  const add = (some: Manifest["models"], prefix: string): void => {
    for (const model of some) {
      const name = prefix + model.name;
      for (const { name: link, body } of model.links) {
        const key = byFrame ? link : `${name}::${link}`;
        if (!bodies.has(key)) bodies.set(key, body);
      }
      add(model.models, `${name}::`);
    }
  };
  add(models, "");
  return bodies;
}
