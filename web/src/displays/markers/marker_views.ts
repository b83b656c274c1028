/** Objects of markers that are not drawn as instances together: lines, points, texts, meshes, triangles, long lists. */

import { BufferAttribute, BufferGeometry, DoubleSide, Group, Matrix4, Mesh, type Object3D } from "three";

import type { ColorRGBA, Marker, Point } from "../../protocol/generated/ros_messages";
import type { Connection } from "../../protocol/connection";
import { meshLibrary } from "../meshes/mesh_library";
import { BillboardLines } from "../../shapes/billboard_lines";
import { BillboardPoints } from "../../shapes/billboard_points";
import { flatMaterial, ShapeMaterial } from "../../shapes/shape_material";
import { TextBillboard } from "../../shapes/text_billboard";
import { SolidBatches } from "./solid_batches";
import { isSolid } from "./marker_parts";
import { Type } from "./marker_type";

export interface MarkerView {
  readonly object: Object3D;
  dispose(): void;
}

/** Parts that views of markers use. */
export interface ViewParts {
  readonly connection: Connection;
  readonly describe: (marker: Marker) => Readonly<Record<string, unknown>>;
  readonly onFault: (marker: Marker, text: string, advice: string) => void;
  readonly onChange: () => void;
}

/** The view of a marker; a solid one gets instances of its own. */
export function makeView(marker: Marker, parts: ViewParts): MarkerView {
  if (isSolid(marker.type)) return solids(marker, parts);
  switch (marker.type) {
    case Type.lineStrip:
    case Type.lineList:
      return lines(marker);
    case Type.points:
      return points(marker);
    case Type.text:
      return text(marker);
    case Type.mesh:
      return mesh(marker, parts);
    default:
      return triangles(marker);
  }
}

/** Share of a marker's color over the mesh's own, as measured on rviz. */
const MAX_TINT = 0.5;

const UNMOVED = new Matrix4();

function solids(marker: Marker, parts: ViewParts): MarkerView {
  const object = new SolidBatches(parts.describe);
  object.begin();
  object.draw(marker, UNMOVED);
  object.finish();
  return { object, dispose: () => object.dispose() };
}

function lines(marker: Marker): MarkerView {
  const object = new BillboardLines(marker.scale.x);
  const positions = packed(marker.points);
  const color = (index: number): readonly number[] => rgba(marker.colors[index] ?? marker.color);
  object.begin();
  if (marker.type === Type.lineStrip) object.addPolyline(positions, color);
  else
    for (let k = 0; k + 1 < marker.points.length; k += 2)
      object.addSegment(positions, 3 * k, positions, 3 * k + 3, color(k), color(k + 1));
  object.finish();
  return { object, dispose: () => object.dispose() };
}

function points(marker: Marker): MarkerView {
  const colors = new Float32Array(4 * marker.points.length);
  marker.points.forEach((_, index) => colors.set(rgba(marker.colors[index] ?? marker.color), 4 * index));
  const object = new BillboardPoints(packed(marker.points), colors, marker.scale.x, marker.scale.y);
  return { object, dispose: () => object.dispose() };
}

function text(marker: Marker): MarkerView {
  const object = new TextBillboard(marker.text, marker.scale.z, rgba(marker.color));
  return { object, dispose: () => object.dispose() };
}

function triangles(marker: Marker): MarkerView {
  const { scale, colors, color } = marker;
  const perTriangle = colors.length > 0 && 3 * colors.length === marker.points.length;
  const material = colors.length > 0 ? flatMaterial({ vertexColors: true }) : new ShapeMaterial({ side: DoubleSide });
  const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(packed(marker.points), 3));
  if (colors.length > 0) {
    const values = new Float32Array(4 * marker.points.length);
    marker.points.forEach((_, index) => {
      const { r, g, b, a } = colors[perTriangle ? Math.floor(index / 3) : index] ?? color;
      values.set([r, g, b, a * color.a], 4 * index); // rviz multiplies the alphas of triangles, and of nothing else
    });
    geometry.setAttribute("vertexRgba", new BufferAttribute(values, 4));
    material.setBlended(colors.some(({ a }) => a * color.a < 0.9998));
  } else material.setRgba(...rgba(color));
  geometry.computeVertexNormals();
  const object = new Mesh(geometry, material);
  object.scale.set(scale.x, scale.y, scale.z);
  return {
    object: new Group().add(object),
    dispose: () => {
      geometry.dispose();
      material.dispose();
    },
  };
}

function mesh(marker: Marker, { connection, onFault, onChange }: ViewParts): MarkerView {
  const object = new Group();
  object.scale.set(marker.scale.x, marker.scale.y, marker.scale.z);
  let isDisposed = false;
  let materials: readonly ShapeMaterial[] = [];
  meshLibrary(connection)
    .copy(marker.mesh_resource)
    .then(
      (copy) => {
        if (isDisposed) return;
        materials = paintMesh(marker, copy.object, copy.materials);
        object.add(copy.object);
        onChange();
      },
      (error: unknown) => {
        if (isDisposed) return;
        const reason = error instanceof Error ? error.message : String(error);
        onFault(marker, `Could not load mesh resource '${marker.mesh_resource}'`, reason);
      },
    );
  return {
    object: new Group().add(object),
    dispose: () => {
      isDisposed = true;
      for (const material of materials) material.dispose();
    },
  };
}

/** Give embedded materials the marker's alpha and up to half of its color, unless all zeros; other meshes its color. */
function paintMesh(marker: Marker, object: Object3D, embedded: readonly ShapeMaterial[]): readonly ShapeMaterial[] {
  const [red, green, blue, alpha] = rgba(marker.color);
  if (marker.mesh_use_embedded_materials) {
    const isPlain = red + green + blue + alpha === 0;
    for (const material of isPlain ? [] : embedded) {
      const { x, y, z, w } = material.color;
      const over = Math.min(alpha, MAX_TINT);
      const both = 1 - (1 - over) * (1 - alpha);
      material.setRgba(x, y, z, w * both);
      material.setTint(red, green, blue, over / both);
    }
    return embedded;
  }
  const material = new ShapeMaterial({ side: DoubleSide });
  material.setRgba(red, green, blue, alpha);
  object.traverse((part) => {
    if (part instanceof Mesh) part.material = material;
  });
  return [material];
}

function packed(list: readonly Point[]): Float32Array<ArrayBuffer> {
  const values = new Float32Array(3 * list.length);
  list.forEach(({ x, y, z }, index) => values.set([x, y, z], 3 * index));
  return values;
}

function rgba({ r, g, b, a }: ColorRGBA): [number, number, number, number] {
  return [r, g, b, a];
}
