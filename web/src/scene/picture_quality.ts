/** Quality of the next picture: a CPU draws coarse pictures while the scene changes, and a sharp one afterwards. */

import { pixelRatio } from "./drawing_canvas";
import type { PictureSize } from "./picking";

/** Time without a change after which a sharp picture is drawn [ms]. */
const REST = 300;
/** Samples per pixel of smooth edges. */
const SAMPLES = 4;

export class PictureQuality {
  /** True if the picture being drawn has all pixels of the screen, and smooth edges. */
  isSharp = false;
  /** Time of the last change [ms]. */
  private changedAt = 0;

  /** `isSlow`: the CPU draws. */
  constructor(private readonly isSlow: boolean) {}

  /** Choose the quality of a picture at a time [ms]; false: none is due. */
  choose(isChanged: boolean, now: number): boolean {
    if (isChanged) this.changedAt = now;
    else if (this.isSharp || now - this.changedAt < REST) return false;
    this.isSharp = !this.isSlow || !isChanged;
    return true;
  }

  /** Samples per pixel; 0: edges are not smoothed. */
  get samples(): number {
    return this.isSharp ? SAMPLES : 0;
  }

  /** Device pixels per pixel of a picture. */
  ratio({ width, height }: PictureSize): number {
    return pixelRatio(width, height, !this.isSharp);
  }
}
