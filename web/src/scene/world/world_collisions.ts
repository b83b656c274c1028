/** Collision shapes of the simulated world, loaded when they are shown. */

import type { Object3D } from "three";

import { modelOf, type GlbModel } from "./glb_model";
import type { WorldFiles } from "./world_files";

export class WorldCollisions {
  private request = new AbortController();
  private shown: { readonly url: string; readonly model: GlbModel } | null = null;

  /** `onChange`: called when the shapes have come or gone. */
  constructor(
    private readonly files: WorldFiles,
    private readonly onChange: () => void,
  ) {}

  /** Load the shapes of an address; null: none. */
  load(url: string | null): void {
    if ((this.shown?.url ?? null) === url && url !== null) return;
    if (this.shown !== null) for (const shapes of this.shown.model.bodies.values()) shapes.removeFromParent();
    this.shown?.model.dispose();
    this.shown = null;
    this.request.abort();
    this.onChange();
    if (url === null) return;
    const abort = new AbortController();
    this.request = abort;
    void this.files
      .read(url, () => undefined, abort.signal)
      .then(
        (model) => {
          if (abort.signal.aborted) return;
          this.shown = { url, model };
          for (const shapes of model.bodies.values()) {
            delete shapes.userData["body"]; // the world's object of the body has this entry
            shapes.position.set(0, 0, 0);
            shapes.quaternion.identity();
          }
          this.onChange();
        },
        (error: unknown) => {
          if (!abort.signal.aborted) this.files.fault("Collisions", error);
        },
      );
  }

  /** Put the shapes below their bodies' objects, visible by their models' names. */
  show(objectOf: (body: number) => Object3D | null, isShown: (model: string) => boolean): void {
    for (const [body, shapes] of this.shown?.model.bodies ?? []) {
      const object = objectOf(body);
      if (shapes.parent !== object) object?.add(shapes);
      shapes.visible = isShown(modelOf(shapes));
    }
  }
}
