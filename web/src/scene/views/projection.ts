/** Perspective or orthographic; rviz has no such property, so files have it only where it differs from rviz's view. */

import { EnumProperty, type Yaml } from "../../rviz/properties";

const PERSPECTIVE = "Perspective";
const ORTHOGRAPHIC = "Orthographic";

export class ProjectionProperty extends EnumProperty {
  constructor() {
    super("Projection", PERSPECTIVE, [PERSPECTIVE, ORTHOGRAPHIC]);
  }

  get isOrthographic(): boolean {
    return this.value.peek() === ORTHOGRAPHIC;
  }

  toggle(): void {
    this.value.value = this.isOrthographic ? PERSPECTIVE : ORTHOGRAPHIC;
  }

  override save(): Yaml | undefined {
    return this.isOrthographic ? super.save() : undefined;
  }
}
