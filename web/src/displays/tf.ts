/** TF: axes and names of all frames, with arrows to their parents. */

import type { FrameInfo } from "../frames/frame_tree";
import { NoTransform } from "../frames/transform";
import { Display } from "./display";
import { KeyedProperty } from "./keyed_property";
import { BoolProperty, NumberProperty, StringProperty } from "../rviz/properties";
import { AXIS_RGB } from "../shapes/axes";
import { register } from "./registry";
import { fadeOf, FrameRow, FrameView, TreeProperty } from "./tf/frame_row";
import { TfShapes, type TfStyle } from "./tf/tf_shapes";
import { watch } from "./watch";

/** Update period of ages, parents and read-outs [s]. */
const DETAILS = 0.2;

export class Tf extends Display {
  readonly className = "rviz/TF";
  readonly names = this.add(new BoolProperty("Show Names", true));
  private readonly axes = this.add(new BoolProperty("Show Axes", true));
  private readonly arrows = this.add(new BoolProperty("Show Arrows", true));
  private readonly scale = this.add(new NumberProperty("Marker Scale", 1, { min: 0 }));
  private readonly alpha = this.add(new NumberProperty("Marker Alpha", 1, { min: 0, max: 1 }));
  private readonly interval = this.add(new NumberProperty("Update Interval", 0, { min: 0, unit: "s" }));
  private readonly timeout = this.add(new NumberProperty("Frame Timeout", 15, { min: 1, unit: "s" }));
  private readonly whitelist = this.add(new StringProperty("Filter (whitelist)", ""));
  private readonly blacklist = this.add(new StringProperty("Filter (blacklist)", ""));
  private readonly rows = this.add(new KeyedProperty<FrameRow>("Frames"));
  readonly allFrames = this.rows.add(new BoolProperty("All Enabled", true));
  private readonly tree = this.add(new TreeProperty("Tree"));

  private readonly views = new Map<string, FrameView>();
  private shapes = new TfShapes();
  private style: TfStyle = { axes: true, arrows: true, scale: 1, alpha: 1, colors: AXIS_RGB };
  private isRestyled = true;
  private sinceUpdate = Infinity;
  private sinceDetails = Infinity;
  private wereEnabled = true;
  private stops: (() => void)[] = [];

  protected onStart(): void {
    this.sinceDetails = Infinity;
    this.shapes = new TfShapes();
    this.root.add(this.shapes);
    this.wereEnabled = this.allFrames.value.peek();
    this.stops = [
      watch(
        [this.names, this.axes, this.arrows, this.scale, this.alpha, this.rows, this.whitelist, this.blacklist],
        () => this.restyle(),
      ),
      this.context.axisColors.subscribe(() => this.restyle()),
      this.allFrames.value.subscribe((enabled) => this.enableAll(enabled)),
    ];
  }

  protected onStop(): void {
    for (const stop of this.stops) stop();
    for (const view of this.views.values()) view.dispose();
    this.views.clear();
    this.root.clear();
    this.shapes.dispose();
  }

  override update(now: bigint, elapsed: number): void {
    this.sinceUpdate += elapsed;
    this.sinceDetails += elapsed;
    if (this.sinceUpdate < this.interval.value.peek()) return;
    this.sinceUpdate = 0;
    const details = this.sinceDetails >= DETAILS;
    if (details) this.sinceDetails = 0;
    let changed = (details && this.followTree(now)) || this.isRestyled;
    this.isRestyled = false;
    for (const view of this.views.values()) changed = this.place(view, details) || changed;
    if (!changed) return;
    this.shapes.draw(this.views, this.style);
    this.context.scene.invalidate();
  }

  /** Update a frame's pose; true: it moved, appeared or disappeared. */
  private place(view: FrameView, details: boolean): boolean {
    const fixed = this.context.fixedFrame.peek();
    const pose = this.context.frames.lookup(fixed, view.name, 0n);
    let moved = view.isPlaced;
    if (pose instanceof NoTransform) {
      view.isPlaced = false;
      this.setStatus(view.name, "warn", `No transform from [${view.name}] to frame [${fixed}]`, pose.advice);
    } else {
      moved = view.place(pose);
      this.setStatus(view.name, "ok", "Transform OK");
      if (details) {
        view.row.position.value.value = pose.position.toArray().map(short).join("; ");
        view.row.orientation.value.value = pose.orientation.toArray().map(short).join("; ");
      }
    }
    view.setLabel(view.isShown, this.names.value.peek(), this.style.scale);
    return moved;
  }

  /** Follow new and lost frames, parents and ages; true: the picture changes. */
  private followTree(now: bigint): boolean {
    let changed = false;
    const infos = new Map(
      this.context.frames
        .describe()
        .filter((info) => this.passes(info.name))
        .map((info) => [info.name, info]),
    );
    for (const name of [...this.views.keys()]) {
      if (infos.has(name)) continue;
      this.forget(name);
      changed = true;
    }
    for (const info of infos.values()) {
      const view = this.views.get(info.name) ?? this.appear(info.name);
      view.depth = depthOf(info, infos);
      const age = view.setStamp(commonStamp(info, infos), now);
      changed = view.setKin(info.parent, fadeOf(age, this.timeout.value.peek())) || changed;
      view.row.parent.value.value = info.parent ?? "";
      view.row.age.value.value = info.isStatic || info.parent === null ? "static" : `${short(age)} s`;
      view.row.publisher.value.value = info.publisher ?? "";
    }
    this.tree.draw(new Map([...infos.values()].map((info) => [info.name, info.parent])));
    return changed;
  }

  private appear(name: string): FrameView {
    const row = this.rows.row(name, () => new FrameRow(name, true));
    const view = new FrameView(name, row, this.context.scene);
    this.views.set(name, view);
    this.root.add(view.anchor);
    return view;
  }

  private forget(name: string): void {
    this.views.get(name)?.dispose();
    this.views.delete(name);
    this.rows.forget(name);
    this.clearStatus(name);
  }

  private passes(name: string): boolean {
    const [only, not] = [this.whitelist.value.peek(), this.blacklist.value.peek()];
    return (only === "" || matches(only, name)) && (not === "" || !matches(not, name));
  }

  private restyle(): void {
    this.style = {
      axes: this.axes.value.peek(),
      arrows: this.arrows.value.peek(),
      scale: this.scale.value.peek(),
      alpha: this.alpha.value.peek(),
      colors: this.context.axisColors.peek(),
    };
    this.isRestyled = true;
    this.context.scene.invalidate();
  }

  private enableAll(enabled: boolean): void {
    if (enabled === this.wereEnabled) return;
    this.wereEnabled = enabled;
    for (const [, row] of this.rows.entries()) row.value.value = enabled;
  }
}

/** Oldest of the stamps up to the root; static transforms have none. */
function commonStamp(info: FrameInfo, infos: ReadonlyMap<string, FrameInfo>): bigint {
  let oldest = 0n;
  let frame: FrameInfo | undefined = info;
  for (let steps = 0; frame !== undefined && steps <= infos.size; steps++) {
    if (!frame.isStatic && frame.stamp > 0n && (oldest === 0n || frame.stamp < oldest)) oldest = frame.stamp;
    frame = frame.parent === null ? undefined : infos.get(frame.parent);
  }
  return oldest;
}

/** Number of frames above a frame. */
function depthOf(info: FrameInfo, infos: ReadonlyMap<string, FrameInfo>): number {
  let depth = 0;
  for (let at = info.parent; at !== null && depth <= infos.size; depth++) at = infos.get(at)?.parent ?? null;
  return depth;
}

/** True if a name matches a regular expression, or contains the text if it is no valid expression. */
function matches(expression: string, name: string): boolean {
  try {
    return new RegExp(expression).test(name);
  } catch {
    return name.includes(expression);
  }
}

function short(number: number): string {
  return number.toFixed(3).replace(/^-(0\.0+)$/, "$1");
}

register({ className: "rviz/TF", aliases: [], types: [], create: (context) => new Tf(context) });
