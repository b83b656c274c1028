/** Files .scene: the objects of a planning scene as MoveIt writes them. */

import { Primitive } from "../../displays/moveit/object_shapes";
import type {
  CollisionObject,
  ColorRGBA,
  Mesh,
  Plane,
  Pose,
  SolidPrimitive,
} from "../../protocol/generated/ros_messages";

/** Longest file that is read [characters], and the most shapes, vertices or triangles of a part of it. */
const MAX_LENGTH = 64_000_000;
const MAX_COUNT = 2_000_000;
const IDENTITY: Pose = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
const NO_HEADER = { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "" } as const;

export interface SceneFile {
  readonly name: string;
  readonly objects: readonly CollisionObject[];
  readonly colors: ReadonlyMap<string, ColorRGBA>;
}

/** A file that cannot be read; its message is a sentence. */
export class SceneFileError extends Error {}

/** An object of one shape or several, at a pose of the model's frame. */
export function collisionObject(
  id: string,
  frame: string,
  pose: Pose,
  shapes: Partial<Pick<CollisionObject, "primitives" | "meshes" | "planes">>,
  poses: Partial<Pick<CollisionObject, "primitive_poses" | "mesh_poses" | "plane_poses">> = {},
): CollisionObject {
  const { primitives = [], meshes = [], planes = [] } = shapes;
  return {
    header: { ...NO_HEADER, frame_id: frame },
    pose,
    id,
    type: { key: "", db: "" },
    primitives,
    primitive_poses: poses.primitive_poses ?? primitives.map(() => IDENTITY),
    meshes,
    mesh_poses: poses.mesh_poses ?? meshes.map(() => IDENTITY),
    planes,
    plane_poses: poses.plane_poses ?? planes.map(() => IDENTITY),
    subframe_names: [],
    subframe_poses: [],
    operation: 0,
  };
}

export function writeScene({ name, objects, colors }: SceneFile): string {
  const lines = [name];
  const pose = ({ position: p, orientation: q }: Pose): void =>
    void lines.push(`${p.x} ${p.y} ${p.z}`, `${q.x} ${q.y} ${q.z} ${q.w}`);
  for (const object of objects) {
    const { primitives, meshes, planes } = object;
    const shape = (text: readonly string[], at: Pose | undefined): void => {
      lines.push(...text);
      pose(at ?? IDENTITY);
      const { r, g, b, a } = colors.get(object.id) ?? { r: 0, g: 0, b: 0, a: 0 };
      lines.push(`${r} ${g} ${b} ${a}`);
    };
    lines.push(`* ${object.id}`);
    pose(object.pose);
    lines.push(String(primitives.length + meshes.length + planes.length));
    primitives.forEach((solid, index) => shape(solidLines(solid), object.primitive_poses[index]));
    meshes.forEach((mesh, index) => shape(meshLines(mesh), object.mesh_poses[index]));
    planes.forEach(({ coef }, index) => shape(["plane", [...coef].join(" ")], object.plane_poses[index]));
    lines.push(String(object.subframe_names.length));
    object.subframe_names.forEach((subframe, index) => {
      lines.push(subframe);
      pose(object.subframe_poses[index] ?? IDENTITY);
    });
  }
  return `${[...lines, "."].join("\n")}\n`;
}

function solidLines({ type, dimensions: [a = 0, b = 0, c = 0] }: SolidPrimitive): readonly string[] {
  if (type === Primitive.box) return ["box", `${a} ${b} ${c}`];
  if (type === Primitive.sphere) return ["sphere", String(a)];
  return [type === Primitive.cone ? "cone" : "cylinder", `${b} ${a}`]; // radius and length
}

function meshLines({ vertices, triangles }: Mesh): readonly string[] {
  return [
    "mesh",
    `${vertices.length} ${triangles.length}`,
    ...vertices.map(({ x, y, z }) => `${x} ${y} ${z}`),
    ...triangles.map(({ vertex_indices: [a = 0, b = 0, c = 0] }) => `${a} ${b} ${c}`),
  ];
}

/** Read a file, of MoveIt since Noetic or before, whose objects had no pose of their own. */
export function readScene(text: string, frame: string): SceneFile {
  if (text.length > MAX_LENGTH) throw new SceneFileError("The file is longer than 64 MB.");
  return new SceneReader(text, frame).read();
}

class SceneReader {
  private readonly lines: readonly string[];
  private at = 0;

  constructor(
    text: string,
    private readonly frame: string,
  ) {
    this.lines = text.split(/\r?\n/).map((line) => line.trim());
  }

  read(): SceneFile {
    const name = this.line();
    const objects: CollisionObject[] = [];
    const colors = new Map<string, ColorRGBA>();
    for (let line = this.line(); line !== "."; line = this.line()) {
      if (!line.startsWith("*")) throw this.fault(`expected "* NAME" or ".", not "${line.slice(0, 40)}"`);
      const [object, color] = this.object(line.slice(1).trim());
      objects.push(object);
      if (color !== null) colors.set(object.id, color);
    }
    return { name, objects, colors };
  }

  private object(id: string): readonly [CollisionObject, ColorRGBA | null] {
    const hasPose = (this.lines[this.at] ?? "").includes(" ");
    const pose = hasPose ? this.pose() : IDENTITY;
    const parts: Parts = {
      primitives: [],
      primitive_poses: [],
      meshes: [],
      mesh_poses: [],
      planes: [],
      plane_poses: [],
    };
    let color: ColorRGBA | null = null;
    for (let count = this.count(1)[0] ?? 0; count > 0; count--) {
      this.shape(parts);
      const [r = 0, g = 0, b = 0, a = 0] = this.numbers(4);
      if (r + g + b + a > 0) color = { r, g, b, a };
    }
    const subframes: string[] = [];
    const subframePoses: Pose[] = [];
    for (let count = hasPose ? (this.count(1)[0] ?? 0) : 0; count > 0; count--) {
      subframes.push(this.line());
      subframePoses.push(this.pose());
    }
    const object = collisionObject(id, this.frame, pose, parts, parts);
    return [{ ...object, subframe_names: subframes, subframe_poses: subframePoses }, color];
  }

  private shape(parts: Parts): void {
    const kind = this.line();
    switch (kind) {
      case "box":
        parts.primitives.push({ type: Primitive.box, dimensions: Float64Array.from(this.numbers(3)) });
        parts.primitive_poses.push(this.pose());
        return;
      case "sphere":
        parts.primitives.push({ type: Primitive.sphere, dimensions: Float64Array.from(this.numbers(1)) });
        parts.primitive_poses.push(this.pose());
        return;
      case "cylinder":
      case "cone": {
        const [radius = 0, length = 0] = this.numbers(2);
        parts.primitives.push({ type: Primitive[kind], dimensions: Float64Array.of(length, radius) });
        parts.primitive_poses.push(this.pose());
        return;
      }
      case "plane":
        parts.planes.push({ coef: Float64Array.from(this.numbers(4)) });
        parts.plane_poses.push(this.pose());
        return;
      case "mesh":
        parts.meshes.push(this.mesh());
        parts.mesh_poses.push(this.pose());
        return;
      default:
        throw this.fault(`no shape "${kind.slice(0, 40)}"; shapes: box, sphere, cylinder, cone, plane, mesh`);
    }
  }

  private mesh(): Mesh {
    const [vertices = 0, triangles = 0] = this.count(2);
    const points = Array.from({ length: vertices }, () => {
      const [x = 0, y = 0, z = 0] = this.numbers(3);
      return { x, y, z };
    });
    const corners = Array.from({ length: triangles }, () => {
      const indices = this.numbers(3);
      if (!indices.every((index) => Number.isInteger(index) && index >= 0 && index < vertices))
        throw this.fault(`a triangle names a vertex that is not among the ${vertices}`);
      return { vertex_indices: Uint32Array.from(indices) };
    });
    return { vertices: points, triangles: corners };
  }

  private pose(): Pose {
    const [x = 0, y = 0, z = 0] = this.numbers(3);
    const [qx = 0, qy = 0, qz = 0, qw = 1] = this.numbers(4);
    return { position: { x, y, z }, orientation: { x: qx, y: qy, z: qz, w: qw } };
  }

  private line(): string {
    while (this.lines[this.at] === "") this.at += 1;
    const line = this.lines[this.at];
    if (line === undefined) throw new SceneFileError("The file ends before its last line, which is a dot.");
    this.at += 1;
    return line;
  }

  private numbers(count: number): number[] {
    const line = this.line();
    const numbers = line.split(/\s+/).map(Number);
    if (numbers.length < count || !numbers.every(Number.isFinite))
      throw this.fault(`expected ${count} numbers, not "${line.slice(0, 40)}"`);
    return numbers.slice(0, count);
  }

  private count(count: number): number[] {
    const numbers = this.numbers(count);
    if (!numbers.every((number) => Number.isInteger(number) && number >= 0 && number <= MAX_COUNT))
      throw this.fault(`expected numbers of parts from 0 to ${MAX_COUNT}`);
    return numbers;
  }

  private fault(text: string): SceneFileError {
    return new SceneFileError(`Line ${this.at}: ${text}.`);
  }
}

interface Parts {
  readonly primitives: SolidPrimitive[];
  readonly primitive_poses: Pose[];
  readonly meshes: Mesh[];
  readonly mesh_poses: Pose[];
  readonly planes: Plane[];
  readonly plane_poses: Pose[];
}
