/** rviz's rows of the display MotionPlanning, and the settings of its panel, which its file entry holds. */

import { signal } from "@preact/signals";

import {
  BoolProperty,
  ColorProperty,
  EnumProperty,
  GroupProperty,
  IntProperty,
  NumberProperty,
  VectorProperty,
  type Property,
} from "../../rviz/properties";

type Add = <P extends Property<unknown>>(property: P) => P;

const UNUSED = { description: "Kept for rviz, without effect here." } as const;

/** Rows of the heading Planning Request. */
export class RequestProperties {
  private readonly heading: GroupProperty;
  readonly group: EnumProperty;
  readonly showWorkspace: BoolProperty;
  readonly queryStart: BoolProperty;
  readonly queryGoal: BoolProperty;
  readonly markerSize: NumberProperty;
  readonly startColor: ColorProperty;
  readonly startAlpha: NumberProperty;
  readonly goalColor: ColorProperty;
  readonly goalAlpha: NumberProperty;
  readonly collidingColor: ColorProperty;
  readonly violationColor: ColorProperty;

  constructor(add: Add) {
    this.heading = add(new GroupProperty("Planning Request"));
    const below: Add = (property) => this.heading.add(property);
    this.group = below(
      new EnumProperty("Planning Group", "", [], {
        open: true,
        description: "The name of the group of links to plan for, of those defined in the SRDF.",
      }),
    );
    this.showWorkspace = below(new BoolProperty("Show Workspace", false));
    this.queryStart = below(new BoolProperty("Query Start State", false));
    this.queryGoal = below(new BoolProperty("Query Goal State", true));
    this.markerSize = below(
      new NumberProperty("Interactive Marker Size", 0, { min: 0, unit: "m", description: "0 is auto scale." }),
    );
    this.startColor = below(new ColorProperty("Start State Color", [0, 255, 0]));
    this.startAlpha = below(new NumberProperty("Start State Alpha", 1, { min: 0, max: 1 }));
    this.goalColor = below(new ColorProperty("Goal State Color", [250, 128, 0]));
    this.goalAlpha = below(new NumberProperty("Goal State Alpha", 1, { min: 0, max: 1 }));
    this.collidingColor = below(new ColorProperty("Colliding Link Color", [255, 0, 0]));
    this.violationColor = below(new ColorProperty("Joint Violation Color", [255, 0, 255]));
  }
}

/** Rows of the heading Planning Metrics, which rviz computes itself and the page does not. */
export function addMetrics(add: Add): GroupProperty {
  const metrics = add(new GroupProperty("Planning Metrics", UNUSED));
  for (const name of ["Show Weight Limit", "Show Manipulability Index", "Show Manipulability", "Show Joint Torques"])
    metrics.add(new BoolProperty(name, false, UNUSED));
  metrics.add(new NumberProperty("Payload", 1, { min: 0, unit: "kg", ...UNUSED }));
  metrics.add(new NumberProperty("TextHeight", 0.08, { min: 0.001, unit: "m", ...UNUSED }));
  return metrics;
}

/** Settings of the panel, which rviz saves with the display and shows in the panel only. */
export class PlannerSettings {
  readonly planningTime: NumberProperty;
  readonly attempts: IntProperty;
  readonly velocityScaling: NumberProperty;
  readonly accelerationScaling: NumberProperty;
  readonly replanning: BoolProperty;
  readonly cartesian: BoolProperty;
  readonly collisionAwareIk: BoolProperty;
  readonly approximateIk: BoolProperty;
  readonly usesRadians: BoolProperty;
  readonly workspace: GroupProperty;
  readonly workspaceCenter: VectorProperty;
  readonly workspaceSize: VectorProperty;

  constructor(add: Add) {
    const hidden = { visible: signal(false) };
    const scaling = { min: 0.01, max: 1, ...hidden };
    this.planningTime = add(new NumberProperty("MoveIt_Planning_Time", 5, { min: 0.01, unit: "s", ...hidden }));
    this.attempts = add(new IntProperty("MoveIt_Planning_Attempts", 10, { min: 1, max: 1000, ...hidden }));
    this.velocityScaling = add(new NumberProperty("Velocity_Scaling_Factor", 0.1, scaling));
    this.accelerationScaling = add(new NumberProperty("Acceleration_Scaling_Factor", 0.1, scaling));
    this.replanning = add(new BoolProperty("MoveIt_Allow_Replanning", false, hidden));
    this.cartesian = add(new BoolProperty("MoveIt_Use_Cartesian_Path", false, hidden));
    this.collisionAwareIk = add(new BoolProperty("MoveIt_Use_Constraint_Aware_IK", true, hidden));
    this.approximateIk = add(new BoolProperty("MoveIt_Allow_Approximate_IK", false, hidden));
    this.usesRadians = add(new BoolProperty("JointsTab_Use_Radians", true, hidden));
    this.workspace = add(new GroupProperty("MoveIt_Workspace", hidden));
    this.workspaceCenter = this.workspace.add(new VectorProperty("Center", [0, 0, 0]));
    this.workspaceSize = this.workspace.add(new VectorProperty("Size", [2, 2, 2]));
  }
}
