/** Copies of one geometry, each with its matrix and color: thousands cost one draw call. */

import { InstancedBufferAttribute, InstancedMesh, type BufferGeometry } from "three";

import { ShapeMaterial, type ShapeMaterialOptions } from "./shape_material";

export class Instances extends InstancedMesh<BufferGeometry, ShapeMaterial> {
  private rgba: InstancedBufferAttribute;
  private blended = false;

  /** The geometry is cloned shallowly, since colors belong to it; dispose with `dispose`. */
  constructor(geometry: BufferGeometry, options: ShapeMaterialOptions = {}, capacity = 16) {
    super(shallow(geometry), new ShapeMaterial({ ...options, instanceColors: true }), capacity);
    this.rgba = new InstancedBufferAttribute(new Float32Array(capacity * 4).fill(1), 4);
    this.geometry.setAttribute("instanceRgba", this.rgba);
    this.count = 0;
    this.frustumCulled = false;
  }

  /** Change the number of copies; matrices and colors of kept ones stay. */
  resize(count: number): void {
    if (count > this.instanceMatrix.count) this.grow(Math.max(count, 2 * this.instanceMatrix.count));
    this.count = count;
  }

  /** Color of one copy, 0…1; call `finish` after the last. */
  setRgbaAt(index: number, red: number, green: number, blue: number, alpha: number): void {
    this.rgba.setXYZW(index, red, green, blue, alpha);
    this.blended ||= alpha < 0.9998;
  }

  /** Start to set new colors. */
  begin(count: number): void {
    this.resize(count);
    this.blended = false;
  }

  /** Hand matrices and colors over to the GPU. */
  finish(): void {
    this.material.setBlended(this.blended || this.material.color.w < 0.9998);
    this.instanceMatrix.needsUpdate = true;
    this.rgba.needsUpdate = true;
    this.boundingSphere = null;
    this.boundingBox = null;
  }

  override dispose(): this {
    super.dispose();
    this.freeOwn();
    this.material.dispose();
    return this;
  }

  /** Free the buffers that no other copies of the geometry use. */
  private freeOwn(): void {
    const { geometry } = this;
    const shared = Object.entries(geometry.attributes).filter(([, attribute]) => attribute !== this.rgba);
    const { index } = geometry;
    for (const [name] of shared) geometry.deleteAttribute(name);
    geometry.index = null;
    geometry.dispose();
    for (const [name, attribute] of shared) geometry.setAttribute(name, attribute);
    geometry.index = index;
  }

  private grow(capacity: number): void {
    const matrices = new InstancedBufferAttribute(new Float32Array(capacity * 16), 16);
    matrices.array.set(this.instanceMatrix.array);
    const rgba = new InstancedBufferAttribute(new Float32Array(capacity * 4).fill(1), 4);
    rgba.array.set(this.rgba.array);
    super.dispose(); // frees the old buffers; the mesh itself goes on
    this.freeOwn();
    this.instanceMatrix = matrices;
    this.rgba = rgba;
    this.geometry.setAttribute("instanceRgba", rgba);
  }
}

/** Geometry that shares another's buffers. */
function shallow(geometry: BufferGeometry): BufferGeometry {
  const copy = geometry.clone();
  copy.index = geometry.index;
  for (const [name, attribute] of Object.entries(geometry.attributes)) copy.setAttribute(name, attribute);
  return copy;
}
