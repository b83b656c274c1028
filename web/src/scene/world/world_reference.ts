/** The recording that the world is compared with: fetched when the manifest names it, and shown as a ghost. */

import { signal } from "@preact/signals";
import type { Object3D } from "three";

import type { Manifest, ReferenceInfo } from "../../protocol/generated/page_messages";
import type { Reference } from "../simulated_world";
import type { ThreeScene } from "../three_scene";
import { fetchBytes } from "./glb_model";
import { ReferenceGhost } from "./reference_ghost";
import { ReferenceMotion } from "./reference_motion";

export class WorldReference {
  /** Null: nothing is compared, or it is not loaded yet. */
  readonly current = signal<Reference | null>(null);
  private info: ReferenceInfo | null = null;
  private readonly ghost: ReferenceGhost;
  private abort = new AbortController();
  /** Time since the recording's start that the ghost shows [s]; null: none. */
  private shownAt: number | null = null;
  private readonly removeStep: () => void;

  /** `objectOf`: returns the loaded object of a body; `onFault`: called if the recording cannot be loaded. */
  constructor(
    private readonly scene: ThreeScene,
    private readonly objectOf: (body: number) => Object3D | null,
    private readonly onFault: (error: unknown) => void,
  ) {
    this.ghost = new ReferenceGhost(scene);
    this.removeStep = scene.addStep({ before: () => this.current.peek() !== null && this.ghost.setColor() });
  }

  /** Follow the manifest. */
  setManifest(manifest: Manifest): void {
    const info = manifest.reference;
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

  /** Copy the models again, after their files came or went. */
  rebuild(manifest: Manifest | null): void {
    const loaded = this.current.peek();
    if (loaded === null || manifest === null) return;
    const bodies = bodiesByLink(manifest);
    this.shownAt = null;
    this.ghost.build(loaded.info, (link) => {
      const body = bodies.get(link);
      return body === undefined ? null : this.objectOf(body);
    });
    this.scene.invalidate();
  }

  /** Show the ghost at a time of the world [s]; true: it has moved. */
  show(time: number): boolean {
    const loaded = this.current.peek();
    const since = time - (loaded?.info.start ?? 0);
    if (loaded === null || since === this.shownAt) return false;
    this.shownAt = since;
    this.ghost.show(loaded.motion, since);
    return true;
  }

  hide(isHidden: (link: string) => boolean): void {
    this.ghost.hide(isHidden);
  }

  dispose(): void {
    this.abort.abort();
    this.removeStep();
    this.ghost.dispose();
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

/** Bodies by `model::link`, in which a nested model's link is `model::nested::link`. */
function bodiesByLink({ models }: Pick<Manifest, "models">): ReadonlyMap<string, number> {
  const bodies = new Map<string, number>();
  const add = (some: Manifest["models"], prefix: string): void => {
    for (const model of some) {
      const name = prefix + model.name;
      for (const { name: link, body } of model.links) bodies.set(`${name}::${link}`, body);
      add(model.models, `${name}::`);
    }
  };
  add(models, "");
  return bodies;
}
