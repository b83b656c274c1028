/** Drawings at bodies: joints, centres of mass, inertias, frames, cameras; created only while shown. */

import { effect, untracked } from "@preact/signals";
import { Group, Sphere, Vector3, type Mesh, type Object3D } from "three";

import type { LinkInfo, Manifest, ModelInfo } from "../../protocol/generated/page_messages";
import { NOT_PICKED } from "../picking";
import type { SceneView } from "../scene_view";
import type { SimulatedWorld } from "../simulated_world";
import { drawFrustum } from "./camera_frustum";
import { drawJoint, type JointDrawing } from "./joint_axes";
import { drawCentre, drawInertia } from "./mass";
import { disposeLines, triad } from "./overlay_shapes";
import type { Part } from "./shown_parts";
import { drawOrigin, drawWind } from "./world_marks";

const DRAWN = ["joints", "centres", "inertias", "frames", "cameras"] as const satisfies readonly Part[];
type Drawn = (typeof DRAWN)[number];
/** Sizes of axes [m]. */
const SIZE = { min: 0.05, max: 0.6 };

/** Model with its full name: `outer::inner`. */
export interface NamedModel {
  readonly name: string;
  readonly model: ModelInfo;
}

/** Group at the pose of a body. */
interface Anchor {
  readonly body: number;
  readonly group: Group;
}

export class BodyOverlays {
  private readonly root = new Group();
  /** Drawn objects of each part. */
  private readonly anchors = new Map<Drawn, readonly Anchor[]>();
  private readonly marks = new Group();
  private joints: { readonly index: number; readonly drawing: JointDrawing }[] = [];
  private readonly stops: (() => void)[];

  /** `models`: every model of a manifest, nested ones too. */
  constructor(
    private readonly scene: SceneView,
    private readonly world: SimulatedWorld,
    private readonly models: (manifest: Manifest) => readonly NamedModel[],
  ) {
    this.root.userData[NOT_PICKED] = true;
    this.root.add(this.marks);
    scene.world.add(this.root);
    const { shown } = world;
    this.stops = [
      scene.addStep({ before: () => this.follow() }),
      ...DRAWN.map((part) =>
        effect(() => {
          const manifest = world.manifest.value;
          const isLoaded = world.progress.value === 1; // sizes depend on the loaded models
          if (manifest === null || !isLoaded || !shown.any(part)) this.clear(part);
          else
            this.draw(
              part,
              manifest,
              this.models(manifest).filter(({ name }) => shown.of(part, name)),
            );
        }),
      ),
      effect(() => this.drawMarks(world.manifest.value)),
      effect(() => {
        if (shown.any("joints")) this.moveJoints();
      }),
    ];
  }

  dispose(): void {
    for (const stop of this.stops) stop();
    for (const part of DRAWN) this.clear(part);
    this.root.removeFromParent();
  }

  private draw(part: Drawn, manifest: Manifest, models: readonly NamedModel[]): void {
    this.clear(part);
    const groups = new Map<number, Group>();
    const add = (body: number, object: Object3D): void => {
      let group = groups.get(body);
      if (group === undefined) {
        group = new Group();
        groups.set(body, group);
        this.root.add(group);
      }
      group.add(object);
    };
    if (part === "joints") this.drawJoints(manifest, models, add);
    else if (part === "cameras") {
      const bodies = new Set(models.flatMap(({ model }) => model.links.map(({ body }) => body)));
      for (const camera of manifest.cameras) if (bodies.has(camera.body)) add(camera.body, drawFrustum(camera));
    } else {
      for (const { model } of models) {
        for (const link of model.links)
          if (part === "frames" || (!model.static && link.mass > 0)) add(link.body, this.ofLink(part, link));
      }
    }
    this.anchors.set(
      part,
      [...groups].map(([body, group]) => ({ body, group })),
    );
    this.scene.invalidate();
  }

  private ofLink(part: "centres" | "inertias" | "frames", link: LinkInfo): Object3D {
    if (part === "centres") return drawCentre(link);
    return part === "inertias" ? drawInertia(link) : triad(this.sizeOf(link.body));
  }

  /** A joint's child may be in a nested model, `inner::link`. */
  private drawJoints(
    manifest: Manifest,
    models: readonly NamedModel[],
    add: (body: number, object: Object3D) => void,
  ): void {
    const bodies = new Map(
      this.models(manifest).flatMap(({ name, model }) =>
        model.links.map((link) => [`${name}::${link.name}`, link.body]),
      ),
    );
    for (const { name, model } of models) {
      for (const joint of model.joints) {
        const body = bodies.get(`${name}::${joint.child}`);
        if (body === undefined) continue;
        const drawing = drawJoint(joint, this.sizeOf(body));
        if (joint.index !== null) this.joints.push({ index: joint.index, drawing });
        add(body, drawing.object);
      }
    }
    untracked(() => this.moveJoints());
  }

  private moveJoints(): void {
    const states = this.world.joints.value;
    for (const { index, drawing } of this.joints) drawing.move(states.at(index)?.position ?? 0);
    if (this.joints.length > 0) this.scene.invalidate();
  }

  private drawMarks(manifest: Manifest | null): void {
    const shown = this.world.shown.world.value;
    disposeLines(this.marks);
    this.marks.clear();
    if (shown.get("origin") === true) this.marks.add(drawOrigin());
    if (shown.get("wind") === true && manifest !== null) this.marks.add(drawWind(manifest.physics.wind));
    this.scene.invalidate();
  }

  private clear(part: Drawn): void {
    for (const { group } of this.anchors.get(part) ?? []) {
      disposeLines(group);
      group.removeFromParent();
    }
    this.anchors.delete(part);
    if (part === "joints") this.joints = [];
    this.scene.invalidate();
  }

  /** Move the drawings to their bodies, before each picture. */
  private follow(): void {
    for (const anchors of this.anchors.values()) {
      for (const { body, group } of anchors) {
        const object = this.world.object(body);
        group.visible = object?.visible === true;
        if (object === null) continue;
        group.position.copy(object.position);
        group.quaternion.copy(object.quaternion);
      }
    }
  }

  /** Length of the axes at a body, by its size [m]. */
  private sizeOf(body: number): number {
    const object = this.world.object(body);
    return Math.min(SIZE.max, Math.max(SIZE.min, object === null ? SIZE.min : 1.2 * radiusOf(object)));
  }
}

const sphere = new Sphere();
const origin = new Vector3();

/** Distance of an object's farthest part from its origin [m]. */
function radiusOf(object: Object3D): number {
  object.updateWorldMatrix(true, true);
  origin.setFromMatrixPosition(object.matrixWorld);
  let radius = 0;
  object.traverse((part) => {
    const { geometry } = part as Partial<Mesh>;
    if (geometry === undefined) return;
    if (geometry.boundingSphere === null) geometry.computeBoundingSphere();
    if (geometry.boundingSphere === null) return;
    sphere.copy(geometry.boundingSphere).applyMatrix4(part.matrixWorld);
    radius = Math.max(radius, sphere.center.distanceTo(origin) + sphere.radius);
  });
  return radius;
}
