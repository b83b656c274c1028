/** The recorded world in the scene: a GLB whose animation moves its bodies. */

import { AnimationMixer, Box3, type AnimationAction } from "three";

import type { Manifest } from "../protocol/generated/page_messages";
import type { ThreeScene } from "../scene/three_scene";
import { GlbModel, SharedContents } from "../scene/world/glb_model";
import { Sky } from "../scene/world/sky";
import { WorldLighting } from "../scene/world/world_lighting";

export class RecordedWorld {
  private readonly mixer: AnimationMixer;
  private readonly actions: readonly AnimationAction[];

  private constructor(
    private readonly scene: ThreeScene,
    private readonly model: GlbModel,
    settings: Manifest["scene"],
    private readonly lighting: WorldLighting,
  ) {
    lighting.setScene(settings);
    scene.background.value = `rgb(${settings.background.map((part) => Math.round(255 * part)).join(", ")})`;
    scene.grid.value = settings.grid;
    const sky = new Sky();
    sky.visible = settings.sky;
    scene.world.add(sky, model.root);
    lighting.setContents(scene.world, settings.shadows);
    scene.addStep({ before: (renderer) => lighting.update(renderer, scene.scene) });
    this.mixer = new AnimationMixer(model.root);
    this.actions = model.animations.map((clip) => this.mixer.clipAction(clip).play());
  }

  static async read(scene: ThreeScene, glb: ArrayBuffer, settings: Manifest["scene"]): Promise<RecordedWorld> {
    const lighting = new WorldLighting();
    const model = await GlbModel.read(glb, "", lighting, new SharedContents());
    return new RecordedWorld(scene, model, settings, lighting);
  }

  /** Show it at a time since the recording's start [s]. */
  show(time: number): void {
    for (const action of this.actions) action.time = Math.min(time, action.getClip().duration);
    this.mixer.update(0);
    this.lighting.invalidate();
    this.scene.invalidate();
  }

  /** Bounds of the moving bodies, or without any, of all but infinite planes. */
  bounds(): Box3 {
    this.model.root.updateWorldMatrix(true, true);
    const names = new Set(
      this.model.animations.flatMap(({ tracks }) => tracks.map(({ name }) => name.slice(0, name.lastIndexOf(".")))),
    );
    const bodies = [...this.model.bodies.values()];
    const moving = bodies.filter(({ name }) => names.has(name));
    const box = new Box3();
    for (const body of moving.length > 0 ? moving : bodies) box.union(new Box3().setFromObject(body));
    return box;
  }
}

/** Bytes of gzip as base64. */
export async function unpacked(text: string): Promise<ArrayBuffer> {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}
