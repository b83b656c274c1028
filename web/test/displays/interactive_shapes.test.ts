/** Shapes of interactive markers' controls. */

import { describe, expect, it } from "vitest";

import { InteractionMode } from "../../src/displays/interactive/control_modes";
import { withHandles } from "../../src/displays/interactive/default_handles";
import { withLocalShapes } from "../../src/displays/interactive/local_shapes";
import { NoTransform } from "../../src/frames/transform";
import type { InteractiveMarker, InteractiveMarkerControl, Marker } from "../../src/protocol/generated/ros_messages";
import { FakeFrames } from "./support";

const UNTURNED = { x: 0, y: 0, z: 0, w: 1 };

function control(changes: Partial<InteractiveMarkerControl>): InteractiveMarkerControl {
  return {
    name: "c",
    orientation: UNTURNED,
    orientation_mode: 0,
    interaction_mode: 0,
    always_visible: true,
    markers: [],
    independent_marker_orientation: false,
    description: "Menu",
    ...changes,
  };
}

function marker(controls: readonly InteractiveMarkerControl[]): InteractiveMarker {
  return {
    header: { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "map" },
    pose: { position: { x: 1, y: 2, z: 3 }, orientation: UNTURNED },
    name: "m",
    description: "",
    scale: 2,
    menu_entries: [],
    controls,
  };
}

function shape(frame: string): Marker {
  return {
    header: { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: frame },
    ns: "",
    id: 0,
    type: 1,
    action: 0,
    pose: { position: { x: 0.5, y: 0, z: 0 }, orientation: UNTURNED },
    scale: { x: 1, y: 0, z: 1 },
    color: { r: 1, g: 1, b: 1, a: 1 },
    lifetime: { sec: 0, nsec: 0 },
    frame_locked: false,
    points: [],
    colors: [],
    text: "",
    mesh_resource: "",
    mesh_use_embedded_materials: false,
  };
}

function handle(mode: number, alpha = 0.5): Marker | undefined {
  return withHandles(marker([control({ interaction_mode: mode })]), alpha).controls[0]?.markers[0];
}

describe("default handles of controls", () => {
  it("are a toothed ring for a control that moves and turns, its bright teeth drawn twice", () => {
    const ring = handle(InteractionMode.moveRotate);
    expect(ring?.points).toHaveLength(216);
    expect(ring?.color.a).toBe(0.5);
    expect(ring?.colors.map(({ r, a }) => [r, a]).slice(0, 4)).toEqual([
      [0.6, 1],
      [0.6, 1],
      [1, 0.5],
      [1, 0.5],
    ]);
  });

  it("are a striped ring for turning, and a plain one for moving", () => {
    expect(
      handle(InteractionMode.rotateAxis)
        ?.colors.map(({ r, a }) => [r, a])
        .slice(0, 4),
    ).toEqual([
      [0.6, 1],
      [0.6, 1],
      [1, 1],
      [1, 1],
    ]);
    expect(handle(InteractionMode.movePlane, 1)?.colors).toEqual([]);
    expect(handle(InteractionMode.movePlane, 1)?.color.a).toBe(1);
  });

  it("are a menu's text", () => {
    expect(handle(InteractionMode.menu)).toMatchObject({ type: 9, text: "Menu", scale: { z: 0.5 } });
  });

  it("keep a control's own shapes, with 1 m for missing sizes", () => {
    const [completed] = withHandles(marker([control({ markers: [shape("")] })]), 1).controls[0]?.markers ?? [];
    expect(completed?.scale).toEqual({ x: 1, y: 1, z: 1 });
  });
});

describe("shapes in frames of their own", () => {
  function placed(frame: string, frames: FakeFrames): Marker | NoTransform | undefined {
    const local = withLocalShapes(marker([control({ markers: [shape(frame)] })]), frames);
    return local instanceof NoTransform ? local : local.controls[0]?.markers[0];
  }

  it("are placed in their frame, not at the marker", () => {
    const frames = new FakeFrames();
    frames.set("map", null);
    frames.set("base", "map", [10, 0, 0]);
    expect((placed("map", frames) as Marker).pose.position).toEqual({ x: -0.5, y: -2, z: -3 });
    expect((placed("base", frames) as Marker).pose.position).toEqual({ x: 9.5, y: -2, z: -3 });
    expect((placed("", frames) as Marker).pose.position).toEqual({ x: 0.5, y: 0, z: 0 });
  });

  it("wait for their frame", () => {
    const frames = new FakeFrames();
    frames.set("map", null);
    expect(placed("nowhere", frames)).toBeInstanceOf(NoTransform);
  });
});
