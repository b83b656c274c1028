/** Interactive marker that the page itself serves: handles at a pose in the model's frame. */

import { PerspectiveCamera, Vector3, type Group } from "three";

import { NoTransform, type Transform } from "../../frames/transform";
import type { Pose } from "../../protocol/generated/ros_messages";
import type { Rgb } from "../../rviz/properties";
import type { DisplayContext } from "../display";
import { FeedbackEvent } from "../interactive/control_modes";
import { withHandles } from "../interactive/default_handles";
import { InteractiveMarkerView } from "../interactive/marker_view";
import { BALL, sixDofMarker } from "./six_dof_marker";

/** Radius of the rings in the picture with automatic size [px]: for a mouse, and for a finger. */
const RING_PX = 84;
const RING_FINGER_PX = 104;
/** Radius of the rings at scale 1 [m]. */
const RING_M = 0.65;
const HANDLE_ALPHA = 0.6;
/** Smallest and largest automatic size [m]. */
const SCALES = [0.05, 1] as const;

export interface LocalMarkerParts {
  readonly context: DisplayContext;
  /** Group in the axes of the fixed frame. */
  readonly root: Group;
  /** The model's frame, and its pose in the fixed frame. */
  readonly frame: string;
  readonly anchor: () => Transform | null;
  readonly name: string;
  readonly pose: Pose;
  /** Size [m]; 0: as large in the picture as pointers need. */
  readonly size: number;
  readonly color: Rgb;
  readonly onDrag: (pose: Pose) => void;
  readonly onRelease: () => void;
}

export class LocalMarker {
  private readonly view: InteractiveMarkerView;

  constructor(private readonly parts: LocalMarkerParts) {
    const { context, frame, anchor, name, pose, size, color } = parts;
    const frames = {
      frames: context.frames.frames,
      describe: () => context.frames.describe(),
      lookup: () => anchor() ?? new NoTransform(`No transform from [${frame}] to the fixed frame`, ""),
    };
    this.view = new InteractiveMarkerView(
      withHandles(sixDofMarker(name, frame, pose, size === 0 ? 1 : size, color), HANDLE_ALPHA),
      { ...context, frames },
      {
        connection: context.connection,
        describe: () => ({ Marker: name }),
        onFault: () => undefined,
        onChange: () => context.scene.invalidate(),
      },
      "page",
      ({ event_type: event, pose: dragged }) => {
        if (event === FeedbackEvent.poseUpdate) parts.onDrag(dragged);
        if (event === FeedbackEvent.mouseUp) queueMicrotask(() => parts.onRelease()); // after the view's own release
      },
    );
    parts.root.add(this.view);
  }

  /** Put the handles at a pose; deferred while they are dragged. */
  place(pose: Pose): void {
    this.view.setPose(pose);
  }

  /** Color the ball in the middle; null: its own color. */
  tint(color: Rgb | null): void {
    this.view.tint(BALL, color);
  }

  /** Follow camera and frames; once per frame. */
  update(elapsed: number): void {
    this.view.update(elapsed);
    if (this.parts.size === 0 && !this.view.isDragged) this.view.resize(this.autoScale());
  }

  dispose(): void {
    this.view.removeFromParent();
    this.view.dispose();
  }

  private autoScale(): number {
    const { scene } = this.parts.context;
    const camera = scene.camera.peek();
    const height = scene.paneSize.peek().height;
    const radius = matchMedia("(pointer: coarse)").matches ? RING_FINGER_PX : RING_PX;
    let metresPerPx: number;
    if (camera instanceof PerspectiveCamera) {
      const distance = camera.position.distanceTo(this.view.handlePosition(new Vector3()));
      metresPerPx = (2 * distance * Math.tan((camera.fov * Math.PI) / 360)) / (height * camera.zoom);
    } else metresPerPx = (camera.top - camera.bottom) / (camera.zoom * height);
    return Math.min(SCALES[1], Math.max(SCALES[0], (radius * metresPerPx) / RING_M));
  }
}
