/** octomap_rviz_plugin/OccupancyGrid: an octomap's voxels as cubes. */

import { Group, type Object3D } from "three";

import type { Octomap } from "../protocol/generated/ros_messages";
import { EnumProperty, NumberProperty } from "../rviz/properties";
import type { DisplayContext } from "./display";
import { HistoryDisplay } from "./history_display";
import { readOctomap } from "./octomaps/octomap_reader";
import { COLORINGS, OCCUPIED, RENDERINGS, voxelBoxes } from "./octomaps/voxel_boxes";
import { register } from "./registry";

const TYPES = ["octomap_msgs/Octomap"];
/** Qt's infinity of a float in .rviz files. */
const MAX_FLOAT = 3.4028234663852886e38;

class OctomapDisplay extends HistoryDisplay<Octomap> {
  readonly className = "octomap_rviz_plugin/OccupancyGrid";
  private readonly rendering = this.add(new EnumProperty("Voxel Rendering", OCCUPIED, RENDERINGS));
  private readonly coloring = this.add(new EnumProperty("Voxel Coloring", "Z-Axis", COLORINGS));
  private readonly alpha = this.add(new NumberProperty("Voxel Alpha", 1, { min: 0, max: 1 }));
  private readonly highest = this.add(new NumberProperty("Max. Height Display", MAX_FLOAT, { unit: "m" }));
  private readonly lowest = this.add(new NumberProperty("Min. Height Display", -MAX_FLOAT, { unit: "m" }));

  constructor(context: DisplayContext) {
    super(context, TYPES, "Octomap Topic");
  }

  protected draw(message: Octomap): Object3D {
    const voxels = readOctomap(message);
    if (typeof voxels === "string") {
      this.setStatus("Octomap", "error", voxels);
      return new Group();
    }
    this.setStatus("Octomap", "ok", `${voxels.count} voxels`);
    return voxelBoxes(voxels, {
      rendering: this.rendering.value.peek(),
      coloring: this.coloring.value.peek(),
      alpha: this.alpha.value.peek(),
      heights: [this.lowest.value.peek(), this.highest.value.peek()],
    });
  }
}

register({
  className: "octomap_rviz_plugin/OccupancyGrid",
  aliases: ["octomap_rviz_plugin/ColorOccupancyGrid", "octomap_rviz_plugins/OccupancyGrid"],
  types: TYPES,
  create: (context) => new OctomapDisplay(context),
});
