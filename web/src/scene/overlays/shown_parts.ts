/** Shown parts of the simulated world: of all models, and of single models that differ. */

import { signal } from "@preact/signals";

/** Parts of a model that can be shown, in the order of Gazebo's View menu. */
export const PARTS = [
  "visuals",
  "transparent",
  "wireframe",
  "collisions",
  "joints",
  "centres",
  "inertias",
  "contacts",
  "frames",
  "cameras",
  "rays",
  "points",
  "sonars",
] as const;
export type Part = (typeof PARTS)[number];

/** Parts of the world itself. */
export const WORLD_PARTS = ["grid", "origin", "wind"] as const;
export type WorldPart = (typeof WORLD_PARTS)[number];

/** Model in full (`outer::inner`) → part → shown or not. */
export type ModelParts = ReadonlyMap<string, ReadonlyMap<Part, boolean>>;

export class ShownParts {
  /** Parts shown of all models. */
  readonly all = signal<ReadonlySet<Part>>(new Set(["visuals"]));
  /** Parts of models that differ. */
  readonly models = signal<ModelParts>(new Map());
  /** Shown parts of the world itself; the grid only if it differs from the world's setting. */
  readonly world = signal<ReadonlyMap<WorldPart, boolean>>(new Map());

  /** True if a part of a model is shown; the model's own setting overrides that of its enclosing models. */
  of(part: Part, model: string): boolean {
    let name = model;
    for (;;) {
      const parts = this.models.value.get(name)?.get(part);
      if (parts !== undefined) return parts;
      const at = name.lastIndexOf("::");
      if (at < 0) return this.all.value.has(part);
      name = name.slice(0, at);
    }
  }

  /** True if a part is shown of any model. */
  any(part: Part): boolean {
    if (this.all.value.has(part)) return true;
    for (const parts of this.models.value.values()) if (parts.get(part) === true) return true;
    return false;
  }

  /** Show or hide a part of every model. */
  setAll(part: Part, isShown: boolean): void {
    const all = new Set(this.all.peek());
    if (isShown) all.add(part);
    else all.delete(part);
    this.all.value = all;
    const models = new Map<string, ReadonlyMap<Part, boolean>>();
    for (const [model, parts] of this.models.peek()) {
      const rest = new Map([...parts].filter(([other]) => other !== part));
      if (rest.size > 0) models.set(model, rest);
    }
    this.models.value = models;
  }

  /** Show or hide a part of one model. */
  set(part: Part, model: string, isShown: boolean): void {
    const parts = new Map(this.models.peek().get(model)).set(part, isShown);
    this.models.value = new Map(this.models.peek()).set(model, parts);
  }

  setWorld(part: WorldPart, isShown: boolean): void {
    this.world.value = new Map(this.world.peek()).set(part, isShown);
  }
}
