/** Base of MoveIt's displays: a described robot in its model's frame. */

import { effect, untracked } from "@preact/signals";
import { Group, Matrix4, Quaternion, Vector3 } from "three";

import { NoTransform, type Transform } from "../../frames/transform";
import type { Received, Subscription } from "../../protocol/connection";
import { StringProperty, type Property, type TopicProperty } from "../../rviz/properties";
import { Display } from "../display";
import type { KeyedProperty } from "../keyed_property";
import type { LinkProperty } from "../robot/link_view";
import type { ArmModel } from "./arm_model";
import { watch } from "../watch";
import { describedModel, type Description } from "./description";
import { RobotGhost } from "./robot_ghost";

export function descriptionProperty(): StringProperty {
  return new StringProperty("Robot Description", "robot_description", {
    description: "The name of the ROS parameter where the URDF for the robot is loaded.",
  });
}

const ONE = new Vector3(1, 1, 1);

export abstract class ArmDisplay extends Display {
  /** Subclasses add it where rviz has its row. */
  protected abstract readonly descriptionName: StringProperty;
  /** Group at the model's frame; all that is drawn is below it. */
  protected readonly anchor = new Group();
  /** Pose of the root link in the model's frame. */
  protected rootPose: Matrix4 = new Matrix4();
  readonly described = describedModel(
    () => this.descriptionName.value.value,
    (name) => this.parameter(name),
  );
  private stops: (() => void)[] = [];
  private description: Description | null = null;

  /** Build what depends on the model. */
  protected abstract build(model: ArmModel): void;
  /** Drop what depends on the model. */
  protected abstract drop(): void;

  protected onStart(): void {
    this.root.add(this.anchor);
    this.whileEnabled(() => {
      const description = this.described.value;
      untracked(() => this.describe(description));
    });
  }

  protected onStop(): void {
    for (const stop of this.stops) stop();
    this.stops = [];
    if (this.description?.model) this.drop();
    this.description = null;
    this.root.clear();
  }

  override update(_now: bigint, _elapsed: number): void {
    const model = this.model;
    if (model !== null) this.stand(this.anchor, this.findAnchor(model));
  }

  get model(): ArmModel | null {
    return this.description?.model ?? null;
  }

  /** Run while enabled, at once and whenever a signal that it reads changes. */
  protected whileEnabled(run: () => void): void {
    this.stops.push(effect(run));
  }

  /** Draw while enabled, at once and whenever a property changes. */
  protected whileShown(properties: readonly Property<unknown>[], draw: () => void): void {
    this.stops.push(watch(properties, draw));
  }

  /** Messages of a property's topic while enabled; `isRare`: the display needs none. */
  protected follow(property: TopicProperty, onMessage: (message: never) => void, isRare = false): void {
    let subscription: Subscription | null = null;
    this.whileEnabled(() => {
      const topic = this.context.names.resolve(property.value.value);
      untracked(() => {
        subscription?.close();
        this.setStatus(property.name, isRare ? "ok" : "warn", "No messages received");
        subscription =
          topic === ""
            ? null
            : this.context.connection.subscribe<never>(
                topic,
                (received) => this.onReceived(property, received, onMessage),
                {
                  every: true,
                  onError: (text) => this.setStatus(property.name, "error", text),
                },
              );
      });
    });
    this.stops.push(() => subscription?.close());
  }

  /** A robot below the anchor. */
  protected ghostFor(model: ArmModel, rows: KeyedProperty<LinkProperty>): RobotGhost {
    const ghost = new RobotGhost(
      model,
      this.context.connection,
      rows,
      (uri, reason) => this.setStatus(`Mesh ${uri}`, "error", `Could not load mesh resource '${uri}'`, reason),
      () => this.context.scene.invalidate(),
    );
    this.anchor.add(ghost);
    return ghost;
  }

  /** Pose of the model's frame in the fixed frame: by its own transform, otherwise by the root link's. */
  protected findAnchor(model: ArmModel): Transform | null {
    const { frames } = this.context;
    const fixed = this.context.fixedFrame.peek();
    const own = frames.lookup(fixed, model.frame, 0n);
    if (!(own instanceof NoTransform)) {
      this.setStatus("Transform", "ok", "Transform OK");
      return own;
    }
    const root = frames.lookup(fixed, model.rootLink, 0n);
    if (root instanceof NoTransform) {
      if (fixed === model.frame || fixed === model.rootLink)
        return { position: new Vector3(), orientation: new Quaternion() };
      this.setStatus("Transform", "error", own.text, own.advice);
      return null;
    }
    this.setStatus("Transform", "ok", "Transform OK");
    const pose = new Matrix4().compose(root.position, root.orientation, ONE).multiply(this.rootPose.clone().invert());
    const result = { position: new Vector3(), orientation: new Quaternion() };
    pose.decompose(result.position, result.orientation, new Vector3());
    return result;
  }

  private describe(description: Description): void {
    if (this.description?.model) this.drop();
    this.description = description;
    const { model, fault } = description;
    if (model === null)
      this.setStatus(
        "URDF",
        "error",
        fault,
        'Load a robot description: <param name="robot_description" …/> in the launch file',
      );
    else {
      if (fault === "") this.setStatus("URDF", "ok", "URDF and SRDF parsed OK");
      else this.setStatus("URDF", "warn", fault, "A package of the robot's MoveIt configuration loads it.");
      this.build(model);
    }
    this.context.scene.invalidate();
  }

  private onReceived(
    property: TopicProperty,
    { message, type, topic }: Received<never>,
    onMessage: (message: never) => void,
  ): void {
    if (!property.types.includes(type)) {
      this.setStatus(property.name, "error", `${topic} is of type ${type}, not ${property.types.join(" or ")}`);
      return;
    }
    try {
      onMessage(message);
      this.setStatus(property.name, "ok", "OK");
    } catch (error) {
      this.setStatus(
        property.name,
        "error",
        `Message is not a ${property.types.join(" or ")} as it is known here: ${String(error)}`,
      );
    }
    this.context.scene.invalidate();
  }
}
