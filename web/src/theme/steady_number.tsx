/** A number that keeps its width while its digits change. */

import type { JSX } from "preact";

interface SteadyNumberProps {
  readonly text: string;
  /** Characters of the longest usual text. */
  readonly length: number;
}

export function SteadyNumber({ text, length }: SteadyNumberProps): JSX.Element {
  return (
    <span class="steady" style={{ "--length": length }}>
      {text}
    </span>
  );
}
