/** RobotModel: the links of a robot description, each at its tf frame. */

import { batch, effect, untracked } from "@preact/signals";

import { NoTransform } from "../frames/transform";
import { Display } from "./display";
import { KeyedProperty } from "./keyed_property";
import { BoolProperty, isMapping, NumberProperty, StringProperty, type YamlMapping } from "../rviz/properties";
import { register } from "./registry";
import { LinkView, type LinkProperty } from "./robot/link_view";
import { readUrdf, UrdfError, type Robot } from "./robot/urdf";
import { watch } from "./watch";

export class RobotModel extends Display {
  readonly className = "rviz/RobotModel";
  private readonly visual = this.add(new BoolProperty("Visual Enabled", true));
  private readonly collision = this.add(new BoolProperty("Collision Enabled", false));
  private readonly interval = this.add(new NumberProperty("Update Interval", 0, { min: 0, unit: "s" }));
  private readonly alpha = this.add(new NumberProperty("Alpha", 1, { min: 0, max: 1 }));
  private readonly description = this.add(new StringProperty("Robot Description", "robot_description"));
  private readonly prefix = this.add(new StringProperty("TF Prefix", ""));
  private readonly links = this.add(new KeyedProperty<LinkProperty>("Links"));
  private readonly allLinks = this.links.add(new BoolProperty("All Links Enabled", true));

  private views: LinkView[] = [];
  private text: string | null = null;
  private sinceUpdate = Infinity;
  private wereEnabled = true;
  private stops: (() => void)[] = [];
  private removeShapes: (() => void) | null = null;

  protected onStart(): void {
    this.wereEnabled = this.allLinks.value.peek();
    this.stops = [
      effect(() => {
        const name = this.description.value.value;
        const text = this.parameter(name);
        untracked(() => batch(() => this.describe(name, typeof text === "string" ? text : null)));
      }),
      watch([this.visual, this.collision, this.alpha, this.links], () => this.paint()),
      this.allLinks.value.subscribe((enabled) => this.enableAll(enabled)),
      watch([this.prefix], () => (this.sinceUpdate = Infinity)),
    ];
  }

  protected onStop(): void {
    for (const stop of this.stops) stop();
    this.drop();
    this.text = null;
  }

  override update(_now: bigint, elapsed: number): void {
    this.sinceUpdate += elapsed;
    if (this.sinceUpdate < this.interval.value.peek()) return;
    this.sinceUpdate = 0;
    let changed = false;
    const [fixed, prefix] = [this.context.fixedFrame.peek(), this.prefix.value.peek()];
    for (const view of this.views) {
      const frame = prefix === "" ? view.name : `${prefix.replace(/^\/|\/$/g, "")}/${view.name}`;
      const pose = this.context.frames.lookup(fixed, frame, 0n);
      if (pose instanceof NoTransform) {
        changed = view.place(null) || changed;
        this.setStatus(view.name, "error", `No transform from [${frame}] to [${fixed}]`, pose.advice);
      } else {
        changed = view.place(pose) || changed;
        this.setStatus(view.name, "ok", "Transform OK");
      }
    }
    if (changed) this.context.scene.invalidate();
  }

  /** ROS 2's files name the description's topic; its name is the parameter's. */
  override load(yaml: YamlMapping): string[] {
    const topic = yaml["Description Topic"];
    const faults = super.load(yaml);
    if (yaml["Robot Description"] === undefined && isMapping(topic) && typeof topic["Value"] === "string") {
      this.description.decode(topic["Value"].replace(/^\//, ""));
    }
    return faults;
  }

  private describe(name: string, text: string | null): void {
    if (text === null) {
      this.drop();
      this.text = null;
      const missing = `Parameter [${name}] does not exist, and was not found by searchParam()`;
      this.setStatus(
        "URDF",
        "error",
        missing,
        'Load a robot description: <param name="robot_description" …/> in the launch file',
      );
    } else if (text !== this.text) {
      this.text = text;
      this.build(text);
    }
  }

  private build(text: string): void {
    this.drop();
    let robot: Robot;
    try {
      robot = readUrdf(text);
    } catch (error) {
      if (!(error instanceof UrdfError)) throw error;
      this.setStatus("URDF", "error", "URDF failed Model parse", error.message);
      return;
    }
    const onMissing = (uri: string, reason: string): void =>
      this.setStatus(`Mesh ${uri}`, "error", `Could not load mesh resource '${uri}'`, reason);
    const onChange = (): void => {
      this.context.ghostShapes.change();
      this.context.scene.invalidate();
    };
    this.views = robot.links.map(
      (link) => new LinkView(this.context.connection, link, this.links, onMissing, onChange),
    );
    for (const view of this.views) this.root.add(view);
    const shapes = new Map(this.views.map((view) => [view.name, view.visuals]));
    this.removeShapes = this.context.ghostShapes.add((frame) => shapes.get(frame.replace(/^.*\//, "")) ?? null);
    this.setStatus("URDF", "ok", "URDF parsed OK");
    this.sinceUpdate = Infinity;
    this.paint();
  }

  private drop(): void {
    this.removeShapes?.();
    this.removeShapes = null;
    for (const view of this.views) {
      view.dispose();
      this.links.forget(view.name);
    }
    this.views = [];
    this.root.clear();
    this.statuses.value = new Map();
  }

  private paint(): void {
    for (const view of this.views)
      view.show(this.visual.value.peek(), this.collision.value.peek(), this.alpha.value.peek());
    this.context.scene.invalidate();
  }

  /** Set the checkboxes of all links. */
  private enableAll(enabled: boolean): void {
    if (enabled === this.wereEnabled) return;
    this.wereEnabled = enabled;
    for (const [, row] of this.links.entries()) if (row instanceof BoolProperty) row.value.value = enabled;
  }
}

register({ className: "rviz/RobotModel", aliases: [], types: [], create: (context) => new RobotModel(context) });
