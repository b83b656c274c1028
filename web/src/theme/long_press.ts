/** A finger that rests for half a second: what the right button is for a mouse. */

const DURATION = 500; // ms
/** A longer way is a drag [px]. */
const SLOP = 10;

/** The finger's leaving is no click on what has come under it. */
function swallowClick(): void {
  const swallow = (event: MouseEvent): void => {
    event.preventDefault();
    event.stopPropagation();
  };
  addEventListener("click", swallow, { capture: true, once: true });
  addEventListener("pointerdown", () => removeEventListener("click", swallow, true), { capture: true, once: true });
}

export class LongPress {
  private timer = 0;
  private x = 0;
  private y = 0;

  /** A pointer goes down; a finger that rests does something. */
  begin({ pointerType, clientX, clientY }: PointerEvent, act: () => void): void {
    this.end();
    if (pointerType !== "touch") return;
    [this.x, this.y] = [clientX, clientY];
    this.timer = window.setTimeout(() => {
      swallowClick();
      act();
    }, DURATION);
  }

  move({ clientX, clientY }: PointerEvent): void {
    if (Math.hypot(clientX - this.x, clientY - this.y) > SLOP) this.end();
  }

  /** The finger leaves, or another comes. */
  end(): void {
    clearTimeout(this.timer);
  }
}
