/** Instances of all solid markers: a draw call per shape, twice where some are seen through. */

import { Group, Matrix4, type BufferGeometry } from "three";

import type { ColorRGBA, Marker } from "../../protocol/generated/ros_messages";
import type { Selectable } from "../../scene/scene_view";
import { Instances } from "../../shapes/instances";
import type { ShapeMaterialOptions } from "../../shapes/shape_material";
import { BOX, CLOUD_BOX, CYLINDER, HEAD, SHAFT, SPHERE } from "../../shapes/solids";
import { forEachPart, type PartKind } from "./marker_parts";

/** rviz draws lists as clouds of points, whose boxes and spheres are shaded otherwise. */
const SHAPES: Readonly<
  Record<PartKind, { readonly geometry: BufferGeometry; readonly options?: ShapeMaterialOptions }>
> = {
  box: { geometry: BOX },
  sphere: { geometry: SPHERE },
  cylinder: { geometry: CYLINDER },
  shaft: { geometry: SHAFT },
  head: { geometry: HEAD },
  "list box": { geometry: CLOUD_BOX, options: { shading: "flat", vertexColors: true } },
  "list sphere": { geometry: SPHERE, options: { shading: "soft" } },
};
const OPAQUE = 0.9998;

interface Batch {
  readonly instances: Instances;
  readonly owners: Marker[];
}

const world = new Matrix4();

export class SolidBatches extends Group {
  private readonly batches = new Map<string, Batch>();

  constructor(private readonly describe: (marker: Marker) => Readonly<Record<string, unknown>>) {
    super();
  }

  /** Start a new batch; then `draw` each marker, then `finish`. */
  begin(): void {
    for (const { instances, owners } of this.batches.values()) {
      instances.begin(0);
      owners.length = 0;
    }
  }

  /** Add a marker's parts; the pose is the marker's in this group. */
  draw(marker: Marker, pose: Matrix4): void {
    forEachPart(marker, (kind, matrix, color) => this.emit(marker, kind, world.multiplyMatrices(pose, matrix), color));
  }

  finish(): void {
    for (const { instances, owners } of this.batches.values()) {
      instances.visible = owners.length > 0;
      instances.finish();
    }
  }

  override dispose(): void {
    for (const { instances } of this.batches.values()) instances.dispose();
    this.batches.clear();
    super.clear();
  }

  private emit(marker: Marker, kind: PartKind, matrix: Matrix4, { r, g, b, a }: ColorRGBA): void {
    if (a <= 0) return;
    const { instances, owners } = this.batch(kind, a < OPAQUE);
    const index = owners.push(marker) - 1;
    instances.resize(index + 1);
    instances.setMatrixAt(index, matrix);
    instances.setRgbaAt(index, r, g, b, a);
  }

  private batch(kind: PartKind, blended: boolean): Batch {
    const key = blended ? `${kind} blended` : kind;
    const existing = this.batches.get(key);
    if (existing !== undefined) return existing;
    const { geometry, options } = SHAPES[kind];
    const batch: Batch = { instances: new Instances(geometry, options), owners: [] };
    const selectable: Selectable = {
      describe: (index) => {
        const owner = index === null ? undefined : batch.owners[index];
        return owner === undefined ? {} : this.describe(owner);
      },
    };
    batch.instances.name = "Marker";
    batch.instances.userData["selectable"] = selectable;
    this.batches.set(key, batch);
    super.add(batch.instances);
    return batch;
  }
}
