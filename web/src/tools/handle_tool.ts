/** Base of the tools with handles at the selection: dragging a handle moves a model, a light or a joint. */

import { computed, effect, type ReadonlySignal } from "@preact/signals";
import { Matrix4, Quaternion, Vector3, type Camera, type Ray } from "three";

import { InteractionMode } from "../displays/interactive/control_modes";
import { Drag } from "../displays/interactive/drag";
import { EnumProperty } from "../rviz/properties";
import type { Transform } from "../frames/transform";
import { NOT_PICKED } from "../scene/picking";
import { BaseTool, type ToolContext } from "./base_tool";
import type { Request } from "../protocol/connection";
import type { Drawn, HandleTarget } from "./handles/handle_target";
import { copyOf, targetOf } from "./handles/selection_target";
import { LatestRequest } from "../protocol/latest_request";
import { SelectionHandles, type Handle } from "./handles/selection_handles";
import { selectionOf } from "./picked";
import type { PointerInput } from "../scene/pointer_input";
import { findModel } from "../page/selection_lookup";
import type { WorldEditor } from "../page/world_editor";

/** Wall seconds after which an unchanged drag is sent again; after one second without a request the server ends it. */
const RENEWAL = 0.3;
const MODES = {
  axis: InteractionMode.moveAxis,
  plane: InteractionMode.movePlane,
  free: InteractionMode.movePlane,
  ring: InteractionMode.rotateAxis,
} as const;

interface Dragged {
  readonly target: HandleTarget;
  readonly drawn: Drawn;
  readonly drag: Drag;
  readonly handle: Handle;
  readonly from: Transform;
  /** Requested pose. */
  to: Transform;
  /** Height of the target's origin over its lowest point [m]. */
  readonly height: number;
}

export abstract class HandleTool extends BaseTool {
  override readonly cursor = "default";
  protected abstract readonly axes: EnumProperty;
  private readonly handles = new SelectionHandles();
  private readonly target: ReadonlySignal<HandleTarget | null>;
  private dragged: Dragged | null = null;
  private pointed: PointerInput | null = null;
  private sinceRequest = 0;
  private stops: (() => void)[] = [];
  private readonly requests = new LatestRequest(() => this.abandon());

  constructor(
    context: ToolContext,
    finish: () => void,
    private readonly editor: WorldEditor,
  ) {
    super(context, finish);
    this.target = computed(() => targetOf(editor, context.selection.value));
  }

  /** Hint while nothing is dragged. */
  protected abstract readonly usage: string;
  /** Handles of a target, in the axes of the handles. */
  protected abstract handlesOf(target: HandleTarget): readonly Handle[];
  /** Handle that a press on the target itself uses; null: none. */
  protected abstract readonly body: Handle | null;
  /** Snap the dragged pose. */
  protected abstract snap(to: Transform, from: Transform, input: PointerInput): void;
  /** True if the target is placed on the surface under the pointer. */
  protected abstract standsOnSurface(input: PointerInput, handle: Handle): boolean;
  /** Hint during a drag. */
  protected abstract describe(to: Transform, from: Transform): string;

  activate(): void {
    const { scene } = this.context;
    scene.world.add(this.handles);
    this.stops = [
      () => this.handles.removeFromParent(),
      scene.addStep({ beforePane: (camera, height) => this.place(camera, height) }),
      scene.onTick((elapsed) => this.tick(elapsed)),
      effect(() => {
        const target = this.target.value;
        if (target !== null && target.axis !== null) this.editor.world.joints.value; // eslint-disable-line @typescript-eslint/no-unused-expressions -- follows the joint, whose position a drag starts from
      }),
      effect(() => {
        const target = this.target.value;
        this.handles.show(
          target === null
            ? []
            : target.axis === null
              ? this.handlesOf(target)
              : [{ kind: target.axis.turns ? "ring" : "axis", axis: target.axis.direction }],
        );
        this.hint.value = target === null ? this.selectionUsage : this.usage;
        scene.invalidate();
      }),
    ];
  }

  deactivate(): void {
    if (this.dragged !== null) this.end(this.dragged, true);
    for (const stop of this.stops) stop();
    this.stops = [];
    this.context.scene.invalidate();
  }

  pointer(input: PointerInput): boolean {
    const { dragged } = this;
    if (input.kind === "down") return input.button === 0 && this.press(input);
    if (dragged === null) {
      if (input.kind === "move") this.pointed = input;
      else if (input.kind === "up" && input.button === 0)
        this.context.select(selectionOf(this.context.scene.pick(input.x, input.y)));
      return false;
    }
    if (input.kind === "move") this.pull(dragged, input);
    else this.end(dragged, input.kind === "cancel");
    return true;
  }

  private press(input: PointerInput): boolean {
    const { scene } = this.context;
    const ray = scene.ray(input.x, input.y);
    let target = this.target.peek();
    this.placeForPointer();
    let hit = target === null ? null : (this.handles.hit(ray) ?? this.hitBody(target, input));
    if (hit === null) {
      target = this.selectBody(input);
      hit = target === null ? null : this.hitBody(target, input);
    }
    const from = target?.pose() ?? null;
    if (target === null || from === null || hit === null) return false;
    const { handle } = hit;
    const back = new Vector3()
      .setFromMatrixColumn(scene.camera.peek().matrixWorld, 2)
      .transformDirection(this.worldFromFixed());
    const axis =
      handle.kind === "free"
        ? back
        : handle === this.body
          ? handle.axis.clone()
          : handle.axis.clone().applyQuaternion(this.handles.quaternion);
    const drag = new Drag(
      MODES[handle.kind],
      axis,
      hit.point.applyMatrix4(this.worldFromFixed()),
      from.position.clone(),
      from.orientation.clone(),
      this.inputOf(input, ray),
    );
    const lowest =
      target.bodies.length === 0
        ? from.position.z
        : this.editor.world.bounds(target.bodies).applyMatrix4(this.worldFromFixed()).min.z;
    this.dragged = {
      target,
      drawn: target.begin(),
      drag,
      handle,
      from: copyOf(from),
      to: copyOf(from),
      height: from.position.z - lowest,
    };
    this.handles.light(handle);
    this.ask(this.dragged);
    return true;
  }

  /** Hint while nothing is selected. */
  private get selectionUsage(): string {
    return this.body === null ? "Click an object to move." : "Drag a model, or click an object to move.";
  }

  /** Select the movable model under the pointer, which the press then drags; null: there is none. */
  private selectBody({ x, y }: PointerInput): HandleTarget | null {
    if (this.body === null) return null;
    const selection = selectionOf(this.context.scene.pick(x, y));
    if (selection?.kind !== "link" || findModel(this.editor, selection.model)?.static !== false) return null;
    this.context.select(selection);
    return this.target.peek();
  }

  private hitBody(
    target: HandleTarget,
    { x, y }: PointerInput,
  ): { readonly handle: Handle; readonly point: Vector3 } | null {
    if (this.body === null || target.axis !== null) return null;
    const pick = this.context.scene.pick(x, y);
    for (let at = pick?.object ?? null; at !== null; at = at.parent) {
      if (pick !== null && target.bodies.includes(at.userData["body"] as number))
        return { handle: this.body, point: pick.point.clone() };
    }
    return null;
  }

  private pull(dragged: Dragged, input: PointerInput): void {
    const { scene } = this.context;
    const { drag, from, handle, height, target } = dragged;
    const matrix = scene.camera.peek().matrixWorld;
    const [right, up, back] = [0, 1, 2].map((column) =>
      new Vector3().setFromMatrixColumn(matrix, column).transformDirection(this.worldFromFixed()),
    ) as [Vector3, Vector3, Vector3];
    drag.move(this.inputOf(input, scene.ray(input.x, input.y)), { right, up, back });
    dragged.to = copyOf(drag);
    if (target.axis === null) this.snap(dragged.to, from, input);
    const ground =
      target.axis === null && this.standsOnSurface(input, handle) ? this.surfaceUnder(target, input) : null;
    if (ground !== null) dragged.to.position.set(ground.x, ground.y, ground.z + height);
    this.hint.value = dragged.drawn.describe?.(dragged.to) ?? this.describe(dragged.to, from);
    this.ask(dragged);
    scene.invalidate();
  }

  /** Point of the world where the pointer meets another object than the target. */
  private surfaceUnder(target: HandleTarget, { x, y }: PointerInput): Vector3 | null {
    const { scene } = this.context;
    const objects = target.bodies.flatMap((body) => this.editor.world.object(body) ?? []);
    for (const object of objects) object.userData[NOT_PICKED] = true;
    const point = scene.pick(x, y)?.point ?? scene.pickGround(x, y);
    for (const object of objects) object.userData[NOT_PICKED] = false;
    return point?.clone().applyMatrix4(this.worldFromFixed()) ?? null;
  }

  private end(dragged: Dragged, isCancelled: boolean): void {
    const { target, drawn, from, to } = dragged;
    this.dragged = null;
    this.requests.clear();
    this.handles.light(null);
    this.hint.value = this.usage;
    if (drawn.release !== null) void this.send(target, drawn.release);
    const [after, before] = [drawn.place(to), drawn.place(from)];
    const isMoved = !to.position.equals(from.position) || !to.orientation.equals(from.orientation);
    if (target.isRemembered === true) {
      if (isCancelled || !isMoved) drawn.move(from);
      else void this.send(target, after);
    } else if (isCancelled) void this.send(target, before);
    else if (isMoved) void this.editor.edit(target.title, after.request, after.fields, before.fields);
    this.context.scene.invalidate();
  }

  /** End the drag, since the server refused. */
  private abandon(): void {
    const { dragged } = this;
    this.dragged = null;
    if (dragged?.drawn.release != null) void this.send(dragged.target, dragged.drawn.release);
  }

  private ask({ target, drawn, to }: Dragged): void {
    this.sinceRequest = 0;
    const request = drawn.move(to);
    if (request === null) return;
    this.requests.send(() => this.send(target, request));
  }

  private send(target: HandleTarget, { request, fields }: Request): Promise<boolean> {
    return this.editor.ask(target.title, request, fields);
  }

  private tick(elapsed: number): void {
    this.sinceRequest += elapsed;
    const { dragged, pointed } = this;
    if (dragged !== null && dragged.drawn.release !== null && this.sinceRequest > RENEWAL) this.ask(dragged);
    this.pointed = null;
    if (dragged !== null || pointed === null || pointed.button >= 0) return;
    this.placeForPointer();
    if (this.handles.light(this.handles.hit(this.context.scene.ray(pointed.x, pointed.y))?.handle ?? null))
      this.context.scene.invalidate();
  }

  private placeForPointer(): void {
    const { scene } = this.context;
    this.place(scene.camera.peek(), scene.paneSize.peek().height);
  }

  /** Place the handles at their target, or at its dragged pose, sized for a picture of this height [px]. */
  private place(camera: Camera, height: number): void {
    const target = this.target.peek();
    const pose = this.dragged?.to ?? target?.pose() ?? null;
    this.handles.visible = pose !== null && target !== null;
    if (pose === null || target === null) return;
    const isTurned = target.axis !== null || this.axes.value.peek() === "Model";
    this.handles.place(
      { position: pose.position, orientation: isTurned ? pose.orientation : new Quaternion() },
      camera,
      height,
    );
  }

  private inputOf(
    { x, y, shift, control }: PointerInput,
    ray: Ray,
  ): { ray: Ray; x: number; y: number; shift: boolean; control: boolean } {
    return { ray: ray.clone().applyMatrix4(this.worldFromFixed()), x, y, shift, control };
  }

  private worldFromFixed(): Matrix4 {
    const { world } = this.context.scene;
    world.updateWorldMatrix(true, false);
    return world.matrixWorld.clone().invert();
  }
}
