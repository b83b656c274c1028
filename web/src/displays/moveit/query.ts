/** State that a person plans from or to. */

import { signal } from "@preact/signals";

import type { Positions } from "./arm_model";

/** How the query came to its state: a choice of the panel, or "" for a pose of its own. */
export const CURRENT = "<current>";

/** Smaller motions of a joint are noise [rad, m]. */
const UNSEEN = 1e-4;

export class Query {
  /** Positions of the joints [rad, m]. */
  readonly positions = signal<Positions>(new Map());
  /** The choice that set it: "<current>", a named state; "": joints or tips moved by the person. */
  readonly choice = signal(CURRENT);
  /** Links and objects that touch. */
  readonly colliding = signal<ReadonlySet<string>>(new Set());
  /** True while a dragged tip is where no configuration reaches. */
  readonly isUnreachable = signal(false);
  /** Sentence about the newest drag or check; "": nothing to say. */
  readonly fault = signal("");
  private previous: Positions | null = null;

  constructor(readonly name: "start" | "goal") {}

  /** Set joints; `choice`: where they are from. */
  set(positions: Positions, choice = ""): void {
    this.positions.value = new Map([...this.positions.peek(), ...positions]);
    this.choice.value = choice;
    this.isUnreachable.value = false;
  }

  /** Follow the robot: only while the query is the current state. */
  follow(current: Positions): void {
    if (this.choice.peek() !== CURRENT) return;
    const known = this.positions.peek();
    const isSame = [...current].every(([joint, value]) => Math.abs(value - (known.get(joint) ?? Infinity)) <= UNSEEN);
    if (!isSame) this.positions.value = new Map(current);
  }

  /** Note the state before a plan, for `<previous>`. */
  keep(): void {
    this.previous = this.positions.peek();
  }

  get kept(): Positions | null {
    return this.previous;
  }
}
