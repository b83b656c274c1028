/** A page without a server, a graphics card or a graph: what the shell's tests and its harness show. */

import { signal } from "@preact/signals";
import { Box3, Group, Object3D, PerspectiveCamera, Quaternion, Ray, Vector3 } from "three";

import type { ClockState, Manifest, PageSession, ReferenceInfo } from "../src/protocol/generated/page_messages";
import { CommandList } from "../src/app/commands";
import { Drive } from "../src/page/drive";
import { GoalQueue } from "../src/page/goal_queue";
import { ShownParts } from "../src/scene/overlays/shown_parts";
import type { Page } from "../src/page/page";
import { liveSession } from "../src/page/session";
import { UndoHistory } from "../src/app/undo";
import type { FrameTree } from "../src/frames/frame_tree";
import { NoTransform } from "../src/frames/transform";
import type { SceneView } from "../src/scene/scene_view";
import type { JointStates, Reference, SimulatedWorld } from "../src/scene/simulated_world";
import type { Tool, ToolBox } from "../src/page/tool";
import { AXIS_RGB } from "../src/shapes/axes";
import { GraphNames } from "../src/protocol/graph_names";
import { FakeConnection } from "./fake_connection";
import { FakeDisplayList } from "./fake_displays";
import { FakeViews } from "./fake_views";
import { GhostShapes } from "../src/scene/world/ghost_shapes";

export const SESSION: PageSession = {
  title: "rp2w_at_home",
  kind: "simulation",
  version: "0",
  robot: "rp2w",
  rviz: null,
  fixed_frame: null,
  namespace: "/",
  remappings: {},
  panels: [],
  plots: [],
  images: [],
  drive_topic: "/cmd_vel",
  sliders: [],
  joystick: false,
  terminals: [],
  lesson: null,
  foxglove: "ws://localhost:8080/",
  view_only: false,
  token: "control",
  view_token: "look",
  network_urls: [],
  node: "/trundle_page_1",
};

class FakeWorld implements SimulatedWorld {
  readonly manifest = signal<Manifest | null>(null);
  readonly state = signal<ClockState | null>({
    time_ns: 12.48e9,
    paused: false,
    real_time_factor: 1,
    speed: 1,
    recording: null,
  });
  readonly progress = signal(1);
  readonly isDrawn = signal(true);
  readonly faults = signal<readonly string[]>([]);
  readonly joints = signal<JointStates>([]);
  readonly referenceInfo = signal<ReferenceInfo | null>(null);
  readonly reference = signal<Reference | null>(null);
  readonly shown = new ShownParts();
  readonly hidden = signal<ReadonlySet<string>>(new Set());
  onPoses(): () => void {
    return () => undefined;
  }
  pose(): { position: Vector3; orientation: Quaternion } {
    return {
      position: new Vector3(-0.004, 0.211, 0.089),
      orientation: new Quaternion(0, 0, Math.sin(0.0035), 1).normalize(),
    };
  }
  private readonly body = new Object3D();
  /** Move all bodies to a point [m]. */
  place(at: Vector3): void {
    this.body.position.copy(at);
    this.body.updateMatrixWorld();
  }
  object(): Object3D {
    return this.body;
  }
  box = new Box3(new Vector3(-1, -1, 0), new Vector3(1, 1, 1));
  bounds(): Box3 {
    return this.box;
  }
  extent(): Box3 {
    return this.box;
  }
  private ghost = new Box3();
  /** Compare with a recording whose ghost has an extent. */
  compare(ghost: Box3): void {
    this.ghost = ghost;
    this.reference.value = {} as Reference;
  }
  referenceBounds(): Box3 {
    return this.ghost.clone();
  }
}

export class FakeScene implements SceneView {
  readonly isSlow = false;
  readonly status = signal<SceneView["status"]["value"]>({ kind: "drawing" });
  readonly displays = new Group();
  readonly world = new Group();
  readonly camera = signal(new PerspectiveCamera());
  readonly element = document.createElement("canvas");
  readonly size = signal({ width: 1, height: 1 });
  readonly paneSize = this.size;
  readonly freeArea = signal({ left: 0, right: 0, top: 0, bottom: 0 });
  readonly freePart = signal({ left: 0, top: 0, width: 1, height: 1 });
  readonly background = signal("#16191c");
  readonly grid = signal(true);
  invalidate(): void {
    // nothing is drawn
  }
  private readonly ticks = new Set<(elapsed: number) => void>();
  onTick(callback: (elapsed: number) => void): () => void {
    this.ticks.add(callback);
    return () => this.ticks.delete(callback);
  }
  /** A frame is drawn. */
  tick(elapsed = 0.03): void {
    for (const callback of this.ticks) callback(elapsed);
  }
  /** Frames are drawn for some seconds. */
  wait(seconds: number): void {
    for (let time = 0; time < seconds; time += 0.03) this.tick();
  }
  addStep(): () => void {
    return () => undefined;
  }
  picture(width: number, height: number): HTMLCanvasElement {
    return Object.assign(document.createElement("canvas"), { width, height });
  }
  pick(): null {
    return null;
  }
  pickGround(): null {
    return null;
  }
  pickBox(): [] {
    return [];
  }
  ray(): Ray {
    return new Ray();
  }
  addLabel(anchor: Object3D, text: string): ReturnType<SceneView["addLabel"]> {
    return { anchor, text, detail: "", full: "", rank: null, isQuiet: false, reach: 0, remove: () => undefined };
  }
}

const TOOLS: readonly (readonly [string, string, string, string])[] = [
  ["rviz/Interact", "Interact", "i", "interact"],
  ["rviz/MoveCamera", "Move Camera", "m", "camera_move"],
  ["rviz/Select", "Select", "s", "box"],
  ["rviz/FocusCamera", "Focus Camera", "c", "focus"],
  ["rviz/Measure", "Measure", "n", "measure"],
  ["rviz/SetInitialPose", "2D Pose Estimate", "p", "pose"],
  ["rviz/SetGoal", "2D Nav Goal", "g", "goal"],
  ["rviz/PublishPoint", "Publish Point", "u", "point"],
];

class FakeTools implements ToolBox {
  readonly tools: readonly Tool[] = TOOLS.map(([className, name, shortcut, icon]) => ({
    className,
    name,
    shortcut,
    icon,
    properties: [],
    cursor: "default",
    acts: false,
    navigates: signal(className === "rviz/SetGoal" ? "/goal" : null),
    hint: signal(""),
    activate: () => undefined,
    deactivate: () => undefined,
    pointer: () => false,
  }));
  readonly current = signal<Tool>(this.tools[0] as Tool);
  readonly insert = null;
  use(className: string): void {
    this.current.value = this.tools.find((tool) => tool.className === className) ?? this.current.value;
  }
  save(): [] {
    return [];
  }
  load(): string[] {
    return [];
  }
}

class FakeFrames implements FrameTree {
  readonly frames = signal<readonly string[]>(["base_link", "map", "odom"]);
  describe(): [] {
    return [];
  }
  lookup(target: string, source: string): NoTransform {
    return new NoTransform(`No transform from [${source}] to [${target}]`, "");
  }
}

export interface FakePage extends Page {
  readonly frames: FakeFrames;
  readonly connection: FakeConnection;
  readonly world: FakeWorld;
  readonly scene: FakeScene;
  readonly views: FakeViews;
  readonly displays: FakeDisplayList;
  readonly commands: CommandList;
}

/** The server says that the session has changed. */
export function changeSession({ connection, session }: FakePage, change: Partial<PageSession>): void {
  const payload = new TextEncoder().encode(JSON.stringify({ ...session, ...change }));
  connection.receiveRaw("trundle/session", new DataView(payload.buffer));
}

export function fakePage(session: Partial<PageSession> = {}): FakePage {
  const connection = new FakeConnection();
  const frames = new FakeFrames();
  const scene = new FakeScene();
  const undo = new UndoHistory();
  const live = liveSession({ ...SESSION, ...session }, connection, () => undefined);
  return {
    get session() {
      return live.value;
    },
    connection,
    frames,
    scene,
    views: new FakeViews(),
    world: new FakeWorld(),
    displays: new FakeDisplayList(
      {
        connection,
        names: new GraphNames(),
        frames,
        scene,
        displays: signal([]),
        fixedFrame: signal("map"),
        axisColors: signal(AXIS_RGB),
        ghostShapes: new GhostShapes(),
      },
      undo,
    ),
    tools: new FakeTools(),
    selection: signal(null),
    hovered: signal(null),
    commands: new CommandList(),
    undo,
    goals: new GoalQueue(),
    drive: new Drive({
      connection,
      get session() {
        return live.value;
      },
    }),
    theme: signal("dark"),
    people: signal({ you: 1, people: [] }),
  };
}
