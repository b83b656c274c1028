/** Contacts: a ball where bodies touch and an arrow along the force, from `trundle/contacts` while they are shown. */

import { computed, effect, untracked, type ReadonlySignal } from "@preact/signals";
import { InstancedMesh, Matrix4, Quaternion, Vector3, type BufferGeometry } from "three";

import type { Manifest } from "../../protocol/generated/page_messages";
import { HEAD, SHAFT, SPHERE } from "../../shapes/solids";
import type { Connection } from "../../protocol/connection";
import { NOT_PICKED } from "../picking";
import type { SceneView } from "../scene_view";
import type { SimulatedWorld } from "../simulated_world";
import { contactCount, HEADER, MAX_CONTACTS, SIZE } from "../world/contact_rows";
import type { NamedModel } from "./body_overlays";
import { COLORS, flat, inFront } from "./overlay_shapes";

/** Diameters of a ball and an arrow's shaft and head, longest arrow [m]. */
const [BALL, SHAFT_WIDTH, HEAD_WIDTH, LONGEST] = [0.03, 0.012, 0.03, 2];
/** Length of the arrow of a force as large as the weight of the mean model [m]. */
const LENGTH = 0.4;
const GRAVITY = 9.81;
const X = new Vector3(1, 0, 0);
const TURN = new Quaternion();
const MATRIX = new Matrix4();
const [point, force, size, head] = [new Vector3(), new Vector3(), new Vector3(), new Vector3()] as const;

/** Bodies with shown contacts, static bodies, and the length of an arrow [m/N]. */
interface Chosen {
  readonly shown: ReadonlySet<number>;
  readonly still: ReadonlySet<number>;
  readonly scale: number;
}

export class ContactMarks {
  private readonly balls = instances(SPHERE, COLORS.contact);
  private readonly shafts = instances(SHAFT, COLORS.force);
  private readonly heads = instances(HEAD, COLORS.force);
  private readonly chosen: ReadonlySignal<Chosen>;
  private readonly stop: () => void;

  /** `models`: every model of a manifest, nested ones too. */
  constructor(
    private readonly scene: SceneView,
    private readonly world: SimulatedWorld,
    connection: Connection,
    models: (manifest: Manifest) => readonly NamedModel[],
  ) {
    const { shown, manifest } = world;
    this.chosen = computed(() =>
      choose(manifest.value === null ? [] : models(manifest.value), (name) => shown.of("contacts", name)),
    );
    const isShown = computed(() => shown.any("contacts"));
    this.stop = effect(() => {
      if (!isShown.value) return;
      scene.world.add(this.balls, this.shafts, this.heads);
      const subscription = untracked(() =>
        connection.subscribeRaw("trundle/contacts", (payload) => this.draw(payload)),
      );
      return () => {
        subscription.close();
        for (const mesh of [this.balls, this.shafts, this.heads]) mesh.removeFromParent();
        scene.invalidate();
      };
    });
  }

  dispose(): void {
    this.stop();
    for (const mesh of [this.balls, this.shafts, this.heads]) mesh.dispose();
  }

  private draw(payload: DataView): void {
    const { generation } = this.world.manifest.peek() ?? {};
    const rows = contactCount(payload, generation);
    const { shown, still, scale } = this.chosen.peek();
    let count = 0;
    for (let at = HEADER; at < HEADER + SIZE * rows; at += SIZE) {
      const [first, second] = [payload.getFloat64(at, true), payload.getFloat64(at + 8, true)];
      if (!shown.has(first) && !shown.has(second)) continue;
      point.set(
        payload.getFloat64(at + 16, true),
        payload.getFloat64(at + 24, true),
        payload.getFloat64(at + 32, true),
      );
      force.set(
        payload.getFloat64(at + 40, true),
        payload.getFloat64(at + 48, true),
        payload.getFloat64(at + 56, true),
      );
      if (still.has(second)) force.negate(); // drawn as it acts on the movable body
      this.place(count, scale);
      count += 1;
    }
    for (const mesh of [this.balls, this.shafts, this.heads]) {
      mesh.count = count;
      mesh.instanceMatrix.needsUpdate = true;
    }
    this.scene.invalidate();
  }

  /** Put a ball at the point, and an arrow along the force. */
  private place(index: number, scale: number): void {
    this.balls.setMatrixAt(index, MATRIX.compose(point, TURN.identity(), size.setScalar(BALL)));
    const newtons = force.length();
    const length = Math.min(LONGEST, scale * newtons);
    const headLength = Math.min(HEAD_WIDTH, length);
    if (newtons > 0) force.divideScalar(newtons);
    TURN.setFromUnitVectors(X, newtons > 0 ? force : X);
    this.shafts.setMatrixAt(
      index,
      MATRIX.compose(point, TURN, size.set(length - headLength, SHAFT_WIDTH, SHAFT_WIDTH)),
    );
    head.copy(point).addScaledVector(force, length - headLength);
    this.heads.setMatrixAt(index, MATRIX.compose(head, TURN, size.set(headLength, HEAD_WIDTH, HEAD_WIDTH)));
  }
}

function choose(models: readonly NamedModel[], isShown: (name: string) => boolean): Chosen {
  const bodies = (chosen: readonly NamedModel[]): ReadonlySet<number> =>
    new Set(chosen.flatMap(({ model }) => model.links.map(({ body }) => body)));
  const masses = models
    .filter(({ model }) => !model.static)
    .map(({ model }) => model.links.reduce((sum, { mass }) => sum + mass, 0));
  const mean = masses.reduce((sum, mass) => sum + mass, 0) / Math.max(1, masses.length);
  return {
    shown: bodies(models.filter(({ name }) => isShown(name))),
    still: bodies(models.filter(({ model }) => model.static)),
    scale: mean > 0 ? LENGTH / (mean * GRAVITY) : 0,
  };
}

function instances(geometry: BufferGeometry, color: number): InstancedMesh {
  const mesh = inFront(new InstancedMesh(geometry, flat(color), MAX_CONTACTS));
  mesh.userData[NOT_PICKED] = true;
  mesh.frustumCulled = false;
  mesh.count = 0;
  return mesh;
}
