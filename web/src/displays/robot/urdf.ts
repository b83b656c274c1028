/** Links, joints and materials of a robot's URDF. */

type Triple = readonly [number, number, number];

interface Origin {
  readonly xyz: Triple;
  /** Roll, pitch, yaw about fixed axes [rad]. */
  readonly rpy: Triple;
}

export type Geometry =
  | { readonly kind: "box"; readonly size: Triple }
  | { readonly kind: "cylinder" | "capsule"; readonly radius: number; readonly length: number }
  | { readonly kind: "sphere"; readonly radius: number }
  | { readonly kind: "mesh"; readonly uri: string; readonly scale: Triple };

export interface RobotMaterial {
  readonly name: string;
  readonly rgba: readonly [number, number, number, number] | null;
  readonly texture: string | null;
}

export interface RobotShape {
  readonly origin: Origin;
  readonly geometry: Geometry;
  readonly material: RobotMaterial | null;
}

export interface RobotLink {
  readonly name: string;
  readonly visuals: readonly RobotShape[];
  readonly collisions: readonly RobotShape[];
}

export interface RobotJoint {
  readonly name: string;
  readonly type: string;
  readonly parent: string;
  readonly child: string;
  readonly origin: Origin;
  readonly axis: Triple;
  /** Largest effort [N, N·m]; null: not given. */
  readonly effort: number | null;
  /** Limits of the position [rad, m]; null: not given. */
  readonly lower: number | null;
  readonly upper: number | null;
  readonly mimic: Mimic | null;
}

/** A joint follows another one: position = multiplier × the other's + offset. */
interface Mimic {
  readonly joint: string;
  readonly multiplier: number;
  readonly offset: number;
}

export interface Robot {
  readonly name: string;
  readonly links: readonly RobotLink[];
  readonly joints: readonly RobotJoint[];
}

/** A description that cannot be read; its message is a sentence. */
export class UrdfError extends Error {}

export function readUrdf(text: string): Robot {
  const document = new DOMParser().parseFromString(text.trimStart(), "application/xml");
  const fault = document.querySelector("parsererror")?.textContent.trim().split("\n")[0];
  if (fault !== undefined) throw new UrdfError(`The robot description is not XML: ${fault}`);
  const robot = document.documentElement;
  if (robot.nodeName !== "robot")
    throw new UrdfError(`The robot description begins with <${robot.nodeName}>, not <robot>.`);
  const named = new Map(children(robot, "material").map((node) => [attribute(node, "name"), readMaterial(node)]));
  return {
    name: attribute(robot, "name"),
    links: children(robot, "link").map((node) => ({
      name: attribute(node, "name"),
      visuals: children(node, "visual").flatMap((visual) => readShape(visual, named)),
      collisions: children(node, "collision").flatMap((collision) => readShape(collision, named)),
    })),
    joints: children(robot, "joint").map(readJoint),
  };
}

function readJoint(node: Element): RobotJoint {
  const limit = first(node, "limit");
  const bound = (name: string): number | null => optional(limit?.getAttribute(name));
  const mimic = first(node, "mimic");
  return {
    name: attribute(node, "name"),
    type: attribute(node, "type"),
    parent: attribute(first(node, "parent"), "link"),
    child: attribute(first(node, "child"), "link"),
    origin: readOrigin(node),
    axis: triple(first(node, "axis")?.getAttribute("xyz"), [1, 0, 0]),
    effort: bound("effort"),
    lower: bound("lower"),
    upper: bound("upper"),
    mimic: mimic && {
      joint: attribute(mimic, "joint"),
      multiplier: number(mimic.getAttribute("multiplier"), 1),
      offset: number(mimic.getAttribute("offset"), 0),
    },
  };
}

function readShape(node: Element, named: Map<string, RobotMaterial>): RobotShape[] {
  const geometry = readGeometry(first(node, "geometry"));
  if (geometry === null) return [];
  return [{ origin: readOrigin(node), geometry, material: findMaterial(first(node, "material"), named) }];
}

function readGeometry(node: Element | null): Geometry | null {
  const shape = node?.firstElementChild;
  if (shape === null || shape === undefined) return null;
  const size = (name: string): number => number(shape.getAttribute(name), 0);
  switch (shape.nodeName) {
    case "box":
      return { kind: "box", size: triple(shape.getAttribute("size"), [0, 0, 0]) };
    case "cylinder":
    case "capsule":
      return { kind: shape.nodeName, radius: size("radius"), length: size("length") };
    case "sphere":
      return { kind: "sphere", radius: size("radius") };
    case "mesh":
      return { kind: "mesh", uri: attribute(shape, "filename"), scale: triple(shape.getAttribute("scale"), [1, 1, 1]) };
    default:
      return null;
  }
}

/** Material of a link; one with only a name refers to the robot's or another link's material of that name. */
function findMaterial(node: Element | null, named: Map<string, RobotMaterial>): RobotMaterial | null {
  if (node === null) return null;
  const material = readMaterial(node);
  if (material.rgba === null && material.texture === null) return named.get(material.name) ?? null;
  if (material.name !== "" && !named.has(material.name)) named.set(material.name, material);
  return material;
}

function readMaterial(node: Element): RobotMaterial {
  const color = first(node, "color")?.getAttribute("rgba");
  const [red = 1, green = 1, blue = 1, alpha = 1] = numbers(color);
  const texture = first(node, "texture")?.getAttribute("filename") ?? "";
  return {
    name: attribute(node, "name"),
    rgba: color === undefined || color === null ? null : [red, green, blue, alpha],
    texture: texture === "" ? null : texture,
  };
}

function readOrigin(node: Element): Origin {
  const origin = first(node, "origin");
  return { xyz: triple(origin?.getAttribute("xyz"), [0, 0, 0]), rpy: triple(origin?.getAttribute("rpy"), [0, 0, 0]) };
}

export function children(node: Element, name: string): Element[] {
  return [...node.children].filter((child) => child.nodeName === name);
}

function first(node: Element, name: string): Element | null {
  return children(node, name)[0] ?? null;
}

export function attribute(node: Element | null, name: string): string {
  return node?.getAttribute(name)?.trim() ?? "";
}

function numbers(text: string | null | undefined): number[] {
  return (text ?? "")
    .trim()
    .split(/\s+/)
    .filter((part) => part !== "")
    .map((part) => number(part, 0));
}

function number(text: string | null, otherwise: number): number {
  const value = text === null ? NaN : Number.parseFloat(text);
  return Number.isFinite(value) ? value : otherwise;
}

/** A number that may be absent; text that is no number is 0. */
function optional(text: string | null | undefined): number | null {
  return text === null || text === undefined ? null : number(text, 0);
}

function triple(text: string | null | undefined, otherwise: Triple): Triple {
  const [x, y, z] = numbers(text);
  return x === undefined || y === undefined || z === undefined ? otherwise : [x, y, z];
}
