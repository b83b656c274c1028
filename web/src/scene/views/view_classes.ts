/** rviz's classes of views, by their names in files. */

import { isMapping, type Yaml, type YamlMapping } from "../../rviz/properties";
import type { ViewController } from "../view_controller";
import { Fps } from "./fps";
import { FrameAligned } from "./frame_aligned";
import { Orbit } from "./orbit";
import { SensorCamera } from "./sensor_camera";
import { ThirdPersonFollower } from "./third_person_follower";
import { TopDownOrtho } from "./top_down_ortho";
import type { View } from "./view";
import { XYOrbit } from "./xy_orbit";

const CLASSES: Readonly<Record<string, new () => View>> = {
  "rviz/Orbit": Orbit,
  "rviz/FPS": Fps,
  "rviz/FrameAligned": FrameAligned,
  "rviz/ThirdPersonFollower": ThirdPersonFollower,
  "rviz/TopDownOrtho": TopDownOrtho,
  "rviz/XYOrbit": XYOrbit,
};

export const VIEW_CLASSES = Object.keys(CLASSES);

/** A view of rviz's or ROS 2's class name; null: unknown. */
export function createView(className: string): View | null {
  const [, short = className] = className.split("/");
  const ViewClass = CLASSES[`rviz/${short}`];
  return ViewClass === undefined ? null : new ViewClass();
}

export function copyOfView(view: ViewController, name: string): View {
  const copy = loadView(view.save(), []) ?? new Orbit();
  copy.name.value = name;
  return copy;
}

/** Class of a view of a file; old files have it in `Value`: "Orbit (rviz)". */
export function classOfView(yaml: YamlMapping): string {
  if (typeof yaml["Class"] === "string") return yaml["Class"];
  return typeof yaml["Value"] === "string" ? `rviz/${yaml["Value"].split(" ")[0] ?? ""}` : "rviz/Orbit";
}

/** A view of a file; null: the file has none. */
export function loadView(yaml: Yaml | undefined, faults: string[]): View | null {
  if (!isMapping(yaml)) return null;
  const className = classOfView(yaml);
  const view = SensorCamera.isSavedIn(yaml) ? new SensorCamera() : createView(className);
  if (view === null) faults.push(`Views: there is no view ${className}; Orbit is used`);
  const shown = view ?? new Orbit();
  faults.push(...shown.load(yaml).map((fault) => `Views: ${fault}`));
  return shown;
}
