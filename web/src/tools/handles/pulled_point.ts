/** Pulls a point of a link toward the pointer by a spring, as in MuJoCo's viewer, and draws a line between them. */

import { BufferAttribute, BufferGeometry, Line, LineBasicMaterial, Plane, Vector3, type Matrix4 } from "three";

import { NOT_PICKED } from "../../scene/picking";
import type { SceneView } from "../../scene/scene_view";
import { selectionOf } from "../picked";
import type { PointerInput } from "../../scene/pointer_input";
import type { WorldEditor } from "../../page/world_editor";
import { LatestRequest } from "../../protocol/latest_request";
import { findModel } from "../../page/selection_lookup";

/** Period at which a pull is sent again, even if the pointer rests [ms]; after a second without it the server lets go. */
const RENEWAL = 300;

interface Pulled {
  readonly model: string;
  readonly link: string;
  readonly body: number;
  /** Pulled point in the link's frame. */
  readonly point: Vector3;
  /** Plane through the point, parallel to the picture, in the world. */
  readonly plane: Plane;
  readonly target: Vector3;
}

export class PulledPoint {
  private pulled: Pulled | null = null;
  private stops: (() => void)[] = [];
  private readonly ends = new BufferAttribute(new Float32Array(6), 3);
  private readonly line = new Line(
    new BufferGeometry().setAttribute("position", this.ends),
    new LineBasicMaterial({ depthTest: false }),
  );
  private readonly requests = new LatestRequest(() => this.end());

  constructor(
    private readonly scene: SceneView,
    private readonly editor: WorldEditor,
  ) {
    this.line.frustumCulled = false;
    this.line.renderOrder = 1000;
    this.line.userData[NOT_PICKED] = true;
  }

  /** Grasp the object under the pointer; false: there is none that can be pulled. */
  begin(input: PointerInput): boolean {
    const { scene, editor } = this;
    const pick = scene.pick(input.x, input.y);
    const selection = selectionOf(pick);
    if (pick === null || selection?.kind !== "link" || findModel(editor, selection.model)?.static !== false)
      return false;
    const body = bodyOf(pick.object);
    const pose = body === null ? null : editor.world.pose(body);
    if (body === null || pose === null) return false;
    const target = pick.point.clone().applyMatrix4(this.worldFromFixed());
    const point = target.clone().sub(pose.position).applyQuaternion(pose.orientation.clone().invert());
    const back = new Vector3()
      .setFromMatrixColumn(scene.camera.peek().matrixWorld, 2)
      .transformDirection(this.worldFromFixed());
    const plane = new Plane().setFromNormalAndCoplanarPoint(back, target);
    this.pulled = { model: selection.model, link: selection.link, body, point, plane, target };
    scene.world.add(this.line);
    this.line.material.color.set(getComputedStyle(scene.element).getPropertyValue("--accent").trim() || "#3fbed0");
    this.stops = [scene.addStep({ before: () => this.draw() }), this.renew(), () => this.line.removeFromParent()];
    this.ask(this.pulled);
    return true;
  }

  move({ x, y }: PointerInput): void {
    const { pulled, scene } = this;
    if (pulled === null) return;
    if (scene.ray(x, y).applyMatrix4(this.worldFromFixed()).intersectPlane(pulled.plane, pulled.target) === null)
      return;
    this.ask(pulled);
    scene.invalidate();
  }

  /** Release it. */
  end(): void {
    const { pulled } = this;
    this.pulled = null;
    this.requests.clear();
    for (const stop of this.stops) stop();
    this.stops = [];
    this.scene.invalidate();
    if (pulled !== null) void this.editor.ask("Push", "let_go", { model: pulled.model });
  }

  get isPulling(): boolean {
    return this.pulled !== null;
  }

  private ask({ model, link, point, target }: Pulled): void {
    const fields = { model, link, point: point.toArray(), target: target.toArray() };
    this.requests.send(() => this.editor.ask("Push", "pull", fields));
  }

  /** Send the pull repeatedly; returns a function that stops. */
  private renew(): () => void {
    const timer = setInterval(() => {
      if (this.pulled !== null) this.ask(this.pulled);
    }, RENEWAL);
    return () => clearInterval(timer);
  }

  private draw(): void {
    const pose = this.pulled === null ? null : this.editor.world.pose(this.pulled.body);
    if (this.pulled === null || pose === null) return;
    const { point, target } = this.pulled;
    const at = point.clone().applyQuaternion(pose.orientation).add(pose.position);
    this.ends.setXYZ(0, at.x, at.y, at.z);
    this.ends.setXYZ(1, target.x, target.y, target.z);
    this.ends.needsUpdate = true;
  }

  private worldFromFixed(): Matrix4 {
    const { world } = this.scene;
    world.updateWorldMatrix(true, false);
    return world.matrixWorld.clone().invert();
  }
}

function bodyOf(object: { readonly userData: Record<string, unknown>; readonly parent: unknown }): number | null {
  for (let at: typeof object | null = object; at !== null; at = at.parent as typeof object | null) {
    if (typeof at.userData["body"] === "number") return at.userData["body"];
  }
  return null;
}
