// @vitest-environment jsdom
import "../../src/scene/conventions";

import { Mesh, Quaternion, Ray, Vector3, type Object3D } from "three";
import { describe, expect, it } from "vitest";

import { FeedbackEvent, InteractionMode, OrientationMode } from "../../src/displays/interactive/control_modes";
import { closestOnLine, Drag } from "../../src/displays/interactive/drag";
import { InteractiveMarkers } from "../../src/displays/interactive_markers";
import type {
  InteractiveMarker,
  InteractiveMarkerControl,
  InteractiveMarkerFeedback,
} from "../../src/protocol/generated/ros_messages";
import type { PointerTarget, TargetEvent } from "../../src/scene/scene_view";
import { setup, type Setup } from "./support";

const UNTURNED = { x: 0, y: 0, z: 0, w: 1 };
const VIEW = { right: new Vector3(1, 0, 0), up: new Vector3(0, 1, 0), back: new Vector3(0, 0, 1) };

function control(mode: number, fields: Partial<InteractiveMarkerControl> = {}): InteractiveMarkerControl {
  return {
    name: "control",
    orientation: UNTURNED,
    orientation_mode: OrientationMode.inherit,
    interaction_mode: mode,
    always_visible: true,
    markers: [],
    independent_marker_orientation: false,
    description: "",
    ...fields,
  };
}

function marker(
  controls: readonly InteractiveMarkerControl[],
  fields: Partial<InteractiveMarker> = {},
): InteractiveMarker {
  return {
    header: { seq: 0, stamp: { sec: 0, nsec: 0 }, frame_id: "base" },
    pose: { position: { x: 0, y: 0, z: 0 }, orientation: UNTURNED },
    name: "box",
    description: "A box",
    scale: 1,
    menu_entries: [],
    controls,
    ...fields,
  };
}

interface Started extends Setup {
  readonly display: InteractiveMarkers;
  readonly init: (...markers: readonly InteractiveMarker[]) => void;
  readonly feedback: () => InteractiveMarkerFeedback[];
  readonly target: () => PointerTarget;
}

function started(): Started {
  const base = setup();
  base.frames.set("base", "map", [1, 0, 0]);
  const display = new InteractiveMarkers(base.context);
  display.name.value = "Markers";
  display.load({ "Update Topic": "/menu/update" });
  display.start();
  return {
    ...base,
    display,
    init: (...markers) => {
      base.connection.receive("/menu/update_full", { server_id: "server", seq_num: 5n, markers });
      display.update(0n, 0.01);
      display.root.updateMatrixWorld(true);
    },
    feedback: () => base.connection.published.map(({ message }) => message as unknown as InteractiveMarkerFeedback),
    target: () => {
      let target: PointerTarget | undefined;
      display.root.traverse((part) => (target ??= part.userData["pointerTarget"] as PointerTarget | undefined));
      if (target === undefined) throw new Error("no control");
      return target;
    },
  };
}

/** A pointer whose ray looks down at (x, y). */
function at(root: Object3D, x: number, y: number, fields: Partial<TargetEvent> = {}): TargetEvent {
  const pick = { point: new Vector3(x, y, 0), object: root, index: null };
  return {
    x: 0,
    y: 0,
    ray: new Ray(new Vector3(x, y, 10), new Vector3(0, 0, -1)),
    pick,
    button: 0,
    shift: false,
    control: false,
    ...fields,
  };
}

describe("the servers' protocol", () => {
  const update = (sequence: bigint, fields: object = {}): object => ({
    server_id: "server",
    seq_num: sequence,
    type: 1,
    markers: [],
    poses: [],
    erases: [],
    ...fields,
  });

  it("reads the full state, then updates in sequence", () => {
    const { init, connection, display } = started();
    expect(display.statuses.value.get("General")?.text).toBe("Waiting for messages.");
    init(marker([]));
    expect(display.root.children.map((child) => child.name)).toEqual(["box"]);
    connection.receive("/menu/update", update(6n, { markers: [marker([], { name: "other" })] }));
    connection.receive("/menu/update", update(7n, { erases: ["box"] }));
    expect(display.root.children.map((child) => child.name)).toEqual(["other"]);
    expect(display.statuses.value.get("server")?.text).toBe("OK");
  });

  it("waits for the full state again after a missing update", () => {
    const { init, connection, display } = started();
    init(marker([]));
    connection.receive("/menu/update", update(9n, { erases: ["box"] }));
    expect(display.statuses.value.get("server")?.level).toBe("warn");
    expect(display.root.children).toHaveLength(1);
    connection.receive("/menu/update_full", { server_id: "server", seq_num: 9n, markers: [] });
    expect(display.root.children).toHaveLength(0);
    expect(display.statuses.value.get("server")?.text).toBe("OK");
  });

  it("reports a silent server, and its recovery", () => {
    const { init, connection, display } = started();
    init(marker([]));
    display.update(0n, 2.5);
    expect(display.statuses.value.get("server")?.text).toBe("No update received for at least 2 seconds.");
    connection.receive("/menu/update", update(5n, { type: 0 }));
    expect(display.statuses.value.get("server")?.text).toBe("OK");
  });

  it("finds its topic below the namespace in a file of ROS 2", () => {
    const display = new InteractiveMarkers(setup().context);
    display.load({ Class: "rviz_default_plugins/InteractiveMarkers", "Interactive Markers Namespace": "/menu" });
    expect(display.topic).toBe("/menu/update");
    expect(display.save()).toMatchObject({ "Interactive Markers Namespace": "/menu" });
  });

  it("refuses a topic whose name does not end with /update", () => {
    const display = new InteractiveMarkers(setup().context);
    display.load({ "Update Topic": "/menu" });
    display.start();
    expect(display.statuses.value.get("Topic")?.text).toBe("Invalid topic name: /menu");
  });
});

describe("interactive markers", () => {
  it("have default handles for controls without shapes", () => {
    const { init, display } = started();
    init(marker([control(InteractionMode.moveAxis), control(InteractionMode.rotateAxis)]));
    const meshes: Mesh[] = [];
    display.root.traverse((part) => part instanceof Mesh && meshes.push(part as Mesh));
    expect(meshes.length).toBeGreaterThanOrEqual(5); // two arrows of two parts and a ring
  });

  it("move along their axis and send feedback: down, pose, up", () => {
    const { init, display, feedback, target, connection } = started();
    init(marker([control(InteractionMode.moveAxis)]));
    const handle = target();
    expect(handle.down(at(display.root, 1, 0))).toBe(true);
    handle.move(at(display.root, 3, 2));
    display.update(0n, 0.01);
    handle.up(at(display.root, 3, 2), false);
    const sent = feedback();
    expect(sent.map((message) => message.event_type)).toEqual([
      FeedbackEvent.mouseDown,
      FeedbackEvent.poseUpdate,
      FeedbackEvent.mouseUp,
    ]);
    expect(connection.published[0]).toMatchObject({
      topic: "/menu/feedback",
      type: "visualization_msgs/InteractiveMarkerFeedback",
    });
    expect(sent[1]).toMatchObject({
      client_id: "/trundle_page/Markers",
      marker_name: "box",
      control_name: "control",
      header: { frame_id: "base" },
    });
    expect(sent[1]?.pose.position.x).toBeCloseTo(2);
    expect(sent[1]?.pose.position.y).toBeCloseTo(0);
    expect(sent[0]?.mouse_point).toMatchObject({ x: 0, y: 0 });
  });

  it("send feedback in the fixed frame if their stamp is not 0", () => {
    const { init, display, feedback, target } = started();
    init(
      marker([control(InteractionMode.button)], { header: { seq: 0, stamp: { sec: 1, nsec: 0 }, frame_id: "base" } }),
    );
    target().down(at(display.root, 1, 0));
    expect(feedback()[0]?.header.frame_id).toBe("map");
    expect(feedback()[0]?.pose.position.x).toBeCloseTo(1);
  });

  it("send a button click when it is released over the marker", () => {
    const { init, display, feedback, target } = started();
    init(marker([control(InteractionMode.button)]));
    target().down(at(display.root, 1, 0));
    target().up(at(display.root, 1, 0), false);
    expect(feedback().map((message) => message.event_type)).toEqual([
      FeedbackEvent.mouseDown,
      FeedbackEvent.buttonClick,
      FeedbackEvent.mouseUp,
    ]);
  });

  it("follow the pointer while dragged, and then the server's pose", () => {
    const { init, connection, display, target } = started();
    init(marker([control(InteractionMode.moveAxis)]));
    target().down(at(display.root, 1, 0));
    target().move(at(display.root, 3, 0));
    const pose = { position: { x: 7, y: 0, z: 0 }, orientation: UNTURNED };
    connection.receive("/menu/update", {
      server_id: "server",
      seq_num: 6n,
      type: 1,
      markers: [],
      poses: [{ header: {}, pose, name: "box" }],
      erases: [],
    });
    const place = display.root.children[0]?.children[0];
    expect(place?.position.x).toBeCloseTo(2);
    target().up(at(display.root, 3, 0), false);
    expect(place?.position.x).toBe(7);
  });

  it("send keep-alive feedback while held still", () => {
    const { init, display, feedback, target } = started();
    init(marker([control(InteractionMode.moveAxis)]));
    target().down(at(display.root, 1, 0));
    display.update(0n, 0.3);
    expect(feedback().at(-1)?.event_type).toBe(FeedbackEvent.keepAlive);
  });

  it("open their menu on a right click, nested, and send what was chosen", () => {
    const { init, display, feedback, target, scene } = started();
    Object.assign(scene, { element: document.createElement("canvas") });
    const entry = (id: number, parent: number, title: string, type = 0): object => ({
      id,
      parent_id: parent,
      title,
      command: "rviz",
      command_type: type,
    });
    init(
      marker([control(InteractionMode.moveAxis)], {
        menu_entries: [entry(1, 0, "First"), entry(2, 0, "More"), entry(3, 2, "Inner"), entry(4, 0, "Run", 1)] as never,
      }),
    );
    target().down(at(display.root, 1, 0, { button: 2 }));
    const items = [...document.querySelectorAll<HTMLButtonElement>(".menu button")];
    expect(items.map((item) => [item.textContent, item.disabled])).toEqual([
      ["First", false],
      ["More", true],
      ["Inner", false],
      ["Run", true],
    ]);
    items[2]?.click();
    expect(document.querySelector(".menu")).toBeNull();
    expect(feedback().at(-1)).toMatchObject({
      event_type: FeedbackEvent.menuSelect,
      menu_entry_id: 3,
      control_name: "control",
    });
  });

  it("glow under the pointer", () => {
    const { init, display, target } = started();
    init(marker([control(InteractionMode.moveAxis)]));
    target().hover(true);
    let glow: unknown = 0;
    display.root.traverse((part) => {
      if (part instanceof Mesh)
        glow = (part.material as { uniforms: Record<string, { value: unknown }> }).uniforms["shapeGlow"]?.value;
    });
    expect(glow).toBe(0.3);
  });
});

describe("a drag", () => {
  const down = (x: number, y: number): Ray => new Ray(new Vector3(x, y, 10), new Vector3(0, 0, -1));
  const drag = (mode: number, axis: Vector3, grasp = new Vector3(1, 0, 0)): Drag =>
    new Drag(mode, axis, grasp, new Vector3(), new Quaternion(), {
      ray: down(grasp.x, grasp.y),
      x: 0,
      y: 0,
      shift: false,
      control: false,
    });
  const to = (dragged: Drag, x: number, y: number, fields: object = {}): Drag => {
    dragged.move({ ray: down(x, y), x: 0, y: 0, shift: false, control: false, ...fields }, VIEW);
    return dragged;
  };
  const Z = new Vector3(0, 0, 1);

  it("finds the point of a line nearest to a ray", () => {
    expect(closestOnLine(new Vector3(), new Vector3(1, 0, 0), down(3, 2))).toBeCloseTo(3);
    expect(closestOnLine(new Vector3(), Z, down(3, 2))).toBeNull();
  });

  it("in a plane follows the pointer", () => {
    expect(to(drag(InteractionMode.movePlane, Z), 3, 2).position.toArray()).toEqual([2, 2, 0]);
  });

  it("about an axis turns by the pointer's angle", () => {
    const { orientation, position } = to(drag(InteractionMode.rotateAxis, Z), 0, 2);
    expect(2 * Math.atan2(orientation.z, orientation.w)).toBeCloseTo(Math.PI / 2);
    expect(position.length()).toBe(0);
  });

  it("that moves and turns keeps the grasped point at the pointer", () => {
    const dragged = to(drag(InteractionMode.moveRotate, Z), 0, 3);
    const grasped = new Vector3(1, 0, 0).applyQuaternion(dragged.orientation).add(dragged.position);
    expect(grasped.x).toBeCloseTo(0);
    expect(grasped.y).toBeCloseTo(3);
  });

  it("in space moves in the picture's plane, and nearer with Shift", () => {
    expect(to(drag(InteractionMode.move3D, Z), 2, 1).position.toArray()).toEqual([1, 1, 0]);
    const nearer = drag(InteractionMode.move3D, Z);
    nearer.move({ ray: down(1, 0), x: 0, y: 50, shift: true, control: false }, VIEW);
    expect(nearer.position.z).toBeCloseTo(1);
  });

  it("in space turns about the picture's axes", () => {
    const dragged = drag(InteractionMode.rotate3D, Z);
    dragged.move({ ray: down(1, 0), x: 75, y: 0, shift: false, control: false }, VIEW);
    expect(2 * Math.atan2(dragged.orientation.y, dragged.orientation.w)).toBeCloseTo(Math.PI / 2);
  });
});
