/** Names of the parts of the world that can be shown, and the browser's memory of them. */

import { effect, untracked } from "@preact/signals";

import { PARTS, WORLD_PARTS, type ModelParts, type Part, type WorldPart } from "../../scene/overlays/shown_parts";
import type { Page } from "../../page/page";
import { isOneOf, recall, remember } from "../../page/storage";

/** Gazebo's names, in its menu's order. */
export const PART_NAMES: Readonly<Record<Part, string>> = {
  visuals: "Visuals",
  transparent: "Transparent",
  wireframe: "Wireframe",
  collisions: "Collisions",
  joints: "Joints",
  centres: "Centers of mass",
  inertias: "Inertias",
  contacts: "Contacts",
  frames: "Link frames",
  cameras: "Cameras",
  rays: "Lidar rays",
  points: "Lidar points",
  sonars: "Sonar cones",
};

export const WORLD_PART_NAMES: Readonly<Record<WorldPart, string>> = {
  grid: "Grid",
  origin: "World origin",
  wind: "Wind",
};

/** Parts that only a running simulation has. */
const LIVE: readonly Part[] = ["contacts", "rays", "points", "sonars"];

/** Parts that a page can show. */
export function partsOf({ session }: Page): readonly Part[] {
  return session.kind === "simulation" ? PARTS : PARTS.filter((part) => !LIVE.includes(part));
}

export function isWorldPartShown({ world }: Pick<Page, "world">, part: WorldPart): boolean {
  return world.shown.world.value.get(part) ?? (part === "grid" && world.manifest.value?.scene.grid === true);
}

/** Toggle the visibility of a model, or a link (`model::link`). */
export function toggleHidden({ world, scene }: Pick<Page, "world" | "scene">, name: string): void {
  const names = new Set(world.hidden.peek());
  if (!names.delete(name)) names.add(name);
  world.hidden.value = names;
  scene.invalidate();
}

const isPart = isOneOf(...PARTS);
const isWorldPart = isOneOf(...WORLD_PARTS);

type Saved<Key extends string> = readonly (readonly [Key, boolean])[];

/** Remember the shown parts: those of all models for every world, those of single models for the world of this name. */
export function rememberShown({ world }: Pick<Page, "world">): void {
  const { shown } = world;
  shown.all.value = new Set(recall("shown", ["visuals"], isListOf(isPart)));
  shown.world.value = new Map(recall<Saved<WorldPart>>("shown.world", [], isListOf(isPair(isWorldPart))));
  effect(() => remember("shown", [...shown.all.value]));
  effect(() => remember("shown.world", [...shown.world.value]));
  let recalled: string | null = null;
  effect(() => {
    const name = world.manifest.value?.name;
    if (name === undefined) return;
    if (name !== recalled) {
      recalled = name;
      const saved = recall<readonly (readonly [string, Saved<Part>])[]>(`shown.models.${name}`, [], isListOf(isModel));
      untracked(
        () =>
          (shown.models.value = new Map(saved.map(([model, parts]) => [model, new Map(parts)])) satisfies ModelParts),
      );
    }
    remember(
      `shown.models.${name}`,
      [...shown.models.value].map(([model, parts]) => [model, [...parts]]),
    );
  });
}

type Guard<T> = (value: unknown) => value is T;

function isListOf<T>(is: Guard<T>): Guard<readonly T[]> {
  return (value): value is readonly T[] => Array.isArray(value) && value.every(is);
}

function isPair<Key extends string>(isKey: Guard<Key>): Guard<readonly [Key, boolean]> {
  return (value): value is readonly [Key, boolean] =>
    Array.isArray(value) && value.length === 2 && isKey(value[0]) && typeof value[1] === "boolean";
}

function isModel(value: unknown): value is readonly [string, Saved<Part>] {
  return Array.isArray(value) && typeof value[0] === "string" && isListOf(isPair(isPart))(value[1]);
}
