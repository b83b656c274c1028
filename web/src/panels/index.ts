/** All panels of the dock, in the order in which they are offered. */

import "./panels.css";
import { comparePanel } from "./compare";
import { graphPanel } from "./graph";
import { imagesPanel } from "./images";
import { jointsPanel } from "./joints";
import { joystickPanel } from "./joystick";
import { logPanel } from "./log";
import { motionPlanningPanel } from "./motion_planning";
import { navigationPanel } from "./navigation";
import { nodesPanel } from "./nodes";
import type { Panel } from "./panel";
import { parametersPanel } from "./parameters";
import { performancePanel } from "./performance";
import { plotsPanel } from "./plots";
import { reconfigurePanel } from "./reconfigure";
import { servicesPanel } from "./services";
import { steeringPanel } from "./steering";
import { terminalPanel } from "./terminal";
import { tfTreePanel } from "./tf_tree";
import { timelinePanel } from "./timeline";
import { topicsPanel } from "./topics";

export const panels: readonly Panel[] = [
  plotsPanel,
  topicsPanel,
  logPanel,
  graphPanel,
  timelinePanel,
  performancePanel,
  comparePanel,
  imagesPanel,
  nodesPanel,
  servicesPanel,
  parametersPanel,
  tfTreePanel,
  reconfigurePanel,
  jointsPanel,
  steeringPanel,
  joystickPanel,
  navigationPanel,
  motionPlanningPanel,
  terminalPanel,
];
