/** rviz/Map: an occupancy grid with its updates. */

import { effect, untracked } from "@preact/signals";

import type { Received, Subscription } from "../protocol/connection";
import type { OccupancyGrid, OccupancyGridUpdate } from "../protocol/generated/ros_messages";
import { nanoseconds } from "../protocol/ros_types";
import { NoTransform } from "../frames/transform";
import { Display } from "./display";
import { MapObject } from "./maps/map_object";
import { readMap, writeUpdate, type OccupancyMap } from "./maps/occupancy_map";
import { COLOR_SCHEMES, type ColorScheme } from "./maps/palette";
import { BoolProperty, EnumProperty, NumberProperty, ReadOut, TopicProperty } from "../rviz/properties";
import { register } from "./registry";
import { quaternion, vector } from "../frames/valid";
import { watch } from "./watch";

const TYPE = "nav_msgs/OccupancyGrid";
const UPDATE_TYPE = "map_msgs/OccupancyGridUpdate";

export class MapDisplay extends Display {
  readonly className = "rviz/Map";
  readonly topicProperty = this.add(new TopicProperty("Topic", "", [TYPE]));
  readonly alpha = this.add(new NumberProperty("Alpha", 0.7, { min: 0, max: 1 }));
  readonly colorScheme = this.add(new EnumProperty("Color Scheme", "map", COLOR_SCHEMES));
  readonly drawBehind = this.add(
    new BoolProperty("Draw Behind", false, { description: "Draw the map behind everything else." }),
  );
  private readonly resolution = this.add(new ReadOut("Resolution", "", { description: "[m] of a cell" }));
  private readonly width = this.add(new ReadOut("Width", "", { description: "Cells along x" }));
  private readonly height = this.add(new ReadOut("Height", "", { description: "Cells along y" }));
  private readonly position = this.add(
    new ReadOut("Position", "", { description: "Corner of the map in its frame [m]" }),
  );
  private readonly orientation = this.add(
    new ReadOut("Orientation", "", { description: "Quaternion x; y; z; w in its frame" }),
  );
  readonly unreliable = this.add(
    new BoolProperty("Unreliable", false, { description: "Kept for rviz, without effect here." }),
  );
  readonly useTimestamp = this.add(
    new BoolProperty("Use Timestamp", false, { description: "Transform by the map's stamp, else by the newest." }),
  );

  private message: OccupancyGrid | null = null;
  private map: OccupancyMap | null = null;
  /** True while the cells are the message's own bytes, which others read, too. */
  private isShared = true;
  private object: MapObject | null = null;
  private subscriptions: Subscription[] = [];
  private stops: (() => void)[] = [];

  override get topic(): string | null {
    return this.context.names.resolve(this.topicProperty.value.value) || null;
  }

  protected onStart(): void {
    this.stops = [
      effect(() => {
        const topic = this.topicProperty.value.value;
        untracked(() => this.subscribe(topic));
      }),
      watch([this.alpha, this.colorScheme, this.drawBehind], () => this.dress()),
    ];
  }

  protected onStop(): void {
    for (const stop of this.stops) stop();
    this.subscribe("");
  }

  private subscribe(name: string): void {
    for (const subscription of this.subscriptions) subscription.close();
    this.subscriptions = [];
    this.clear();
    const { connection, names } = this.context;
    const topic = names.resolve(name);
    const advice =
      topic === ""
        ? "Choose a topic."
        : connection.topics.peek().has(topic)
          ? undefined
          : `Nothing publishes ${topic}.`;
    this.setStatus("Message", "warn", "No map received", advice);
    if (topic === "") return;
    const onError = (text: string): void => this.setStatus("Map", "error", text);
    this.subscriptions = [
      connection.subscribe<OccupancyGrid>(topic, (received) => this.receive(received), { onError }),
      connection.subscribe<OccupancyGridUpdate>(
        names.resolve(`${name}_updates`),
        (received) => this.receiveUpdate(received),
        { every: true, onError },
      ),
    ];
  }

  private clear(): void {
    this.object?.dispose();
    this.root.clear();
    this.object = null;
    this.map = null;
    this.message = null;
    for (const name of ["Map", "Update", "Transform"]) this.clearStatus(name);
    this.context.scene.invalidate();
  }

  private receive({ type, message }: Received<OccupancyGrid>): void {
    const map = type === TYPE ? readMap(message) : `${this.topic ?? ""} is of type ${type}, not ${TYPE}`;
    if (typeof map === "string") {
      this.setStatus("Map", "error", map);
      return;
    }
    this.setStatus("Message", "ok", "Map received");
    this.setStatus("Map", map.fault === null ? "ok" : "error", map.fault ?? "Map OK");
    this.clearStatus("Update");
    this.message = message;
    this.map = map;
    this.isShared = true;
    this.draw(map);
    this.describe(message);
  }

  private receiveUpdate({ type, message }: Received<OccupancyGridUpdate>): void {
    if (this.map === null || type !== UPDATE_TYPE) return;
    if (this.isShared) {
      this.map = { ...this.map, cells: this.map.cells.slice() };
      this.isShared = false;
      this.object?.setMap(this.map);
    }
    const region = writeUpdate(this.map, message);
    if (typeof region === "string") {
      this.setStatus("Update", "error", region);
      return;
    }
    this.clearStatus("Update");
    this.object?.refresh(region);
    this.context.scene.invalidate();
  }

  private draw(map: OccupancyMap): void {
    if (this.object?.fits(map) === true) this.object.setMap(map);
    else {
      this.object?.dispose();
      this.root.clear();
      this.object = new MapObject(map);
      this.root.add(this.object);
      this.dress();
    }
    this.place();
    this.context.scene.invalidate();
  }

  private dress(): void {
    this.object?.setLook(
      this.colorScheme.value.peek() as ColorScheme,
      this.alpha.value.peek(),
      this.drawBehind.value.peek(),
    );
    this.context.scene.invalidate();
  }

  private describe({ info }: OccupancyGrid): void {
    const { position, orientation } = info.origin;
    this.resolution.value.value = short(info.resolution);
    this.width.value.value = String(info.width);
    this.height.value.value = String(info.height);
    this.position.value.value = [position.x, position.y, position.z].map(short).join("; ");
    this.orientation.value.value = [orientation.x, orientation.y, orientation.z, orientation.w].map(short).join("; ");
  }

  override update(): void {
    this.place();
  }

  /** Place the map at its frame's current pose. */
  private place(): void {
    if (this.message === null) return;
    const { header, info } = this.message;
    const frame = header.frame_id === "" ? "map" : header.frame_id;
    const stamp = this.useTimestamp.value.peek() ? nanoseconds(header.stamp) : 0n;
    const isAvailable =
      stamp !== 0n &&
      !(this.context.frames.lookup(this.context.fixedFrame.peek(), frame, stamp) instanceof NoTransform);
    const transform = this.transform(frame, isAvailable ? stamp : 0n);
    this.root.visible = transform !== null;
    if (transform === null) return;
    const position = vector(info.origin.position).applyQuaternion(transform.orientation).add(transform.position);
    const orientation = transform.orientation.clone().multiply(quaternion(info.origin.orientation));
    if (position.equals(this.root.position) && orientation.equals(this.root.quaternion)) return;
    this.root.position.copy(position);
    this.root.quaternion.copy(orientation);
    this.context.scene.invalidate();
  }
}

function short(number: number): string {
  return String(Number(number.toFixed(4)));
}

register({ className: "rviz/Map", aliases: [], types: [TYPE], create: (context) => new MapDisplay(context) });
