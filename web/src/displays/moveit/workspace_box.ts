/** Edges of the space in which paths are planned. */

import { BoxGeometry, EdgesGeometry, LineBasicMaterial, LineSegments } from "three";

import type { Triple } from "../../rviz/properties";

const EDGES = new EdgesGeometry(new BoxGeometry(1, 1, 1));
const COLOR = 0x00ff40;

export class WorkspaceBox extends LineSegments {
  constructor() {
    super(EDGES, new LineBasicMaterial({ color: COLOR, toneMapped: false }));
    this.visible = false;
  }

  /** Middle and size [m] in the model's frame. */
  set(center: Triple, size: Triple): void {
    this.position.set(...center);
    this.scale.set(...size);
  }
}
