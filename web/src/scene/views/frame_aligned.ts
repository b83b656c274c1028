/** rviz's FrameAligned: a first person's eye that turns with the target frame. */

import type { Transform } from "../../frames/transform";
import { Fps } from "./fps";

export class FrameAligned extends Fps {
  override readonly className: string = "rviz/FrameAligned";

  protected override frameOf(target: Transform): Transform {
    return target;
  }
}
