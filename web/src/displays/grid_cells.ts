/** rviz/GridCells: flat cells in the plane of their frame. */

import { Group, type Object3D } from "three";

import type { GridCells } from "../protocol/generated/ros_messages";
import { cloudOf } from "./clouds/cloud";
import { cloudObject } from "./clouds/point_cloud_object";
import type { DisplayContext } from "./display";
import { HistoryDisplay } from "./history_display";
import { ColorProperty, NumberProperty } from "../rviz/properties";
import { register } from "./registry";
import { INVALID_FLOATS, isFiniteXyz } from "../frames/valid";

const TYPES = ["nav_msgs/GridCells"];

class GridCellsDisplay extends HistoryDisplay<GridCells> {
  readonly className = "rviz/GridCells";
  private readonly color = this.add(new ColorProperty("Color", [25, 255, 0]));
  private readonly alpha = this.add(new NumberProperty("Alpha", 1, { min: 0, max: 1 }));

  constructor(context: DisplayContext) {
    super(context, TYPES);
  }

  protected override fault({ cells, cell_width, cell_height }: GridCells): string | null {
    if (!Number.isFinite(cell_width) || !Number.isFinite(cell_height) || !cells.every(isFiniteXyz))
      return INVALID_FLOATS;
    if (cell_width === 0) return "Cell width is zero, cells will be invisible.";
    return cell_height === 0 ? "Cell height is zero, cells will be invisible." : null;
  }

  protected draw({ cells, cell_width, cell_height }: GridCells): Object3D {
    const points = Float32Array.from(cells.flatMap(({ x, y, z }) => [x, y, z]));
    const { object, material } = cloudObject(cloudOf(["x", "y", "z"], points), "Tiles");
    const [red, green, blue] = this.color.value.peek();
    material.uniforms.pointSize.value.set(cell_width, cell_height, 0);
    material.uniforms.minColor.value.set(red / 255, green / 255, blue / 255);
    const through = 1 - this.alpha.value.peek();
    material.setAlpha(1 - through * through, false); // rviz draws each cell twice
    return new Group().add(object);
  }

  protected override describe({ cells, cell_width, cell_height }: GridCells): Readonly<Record<string, unknown>> {
    return { Cells: cells.length, Width: cell_width, Height: cell_height };
  }
}

register({
  className: "rviz/GridCells",
  aliases: [],
  types: TYPES,
  create: (context) => new GridCellsDisplay(context),
});
