/** Long press: a finger that rests for half a second, as the right button of a mouse. */

const DURATION = 500; // ms
/** Longer motions are drags [px]. */
const SLOP = 10;

/** Suppress the click of the finger's release on an element that has appeared under it. */
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

  /** Handle a pointer going down; call `act` if a finger rests. */
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

  /** Cancel: the finger was released, or another came down. */
  end(): void {
    clearTimeout(this.timer);
  }
}
