/** Rows of the Inspector: a name with a value, or with editable numbers. */

import type { JSX } from "preact";

import { NumberField } from "../../theme/number_field";

/** Characters of a value that a row shows; the tooltip shows the whole of a longer one. */
const LONG = 20;

export function KeyValue({
  name,
  value,
  unit,
}: {
  readonly name: string;
  readonly value: string;
  readonly unit?: string;
}): JSX.Element {
  return (
    <div class="kv">
      <span>{name}</span>
      <span data-tip={value.length > LONG ? value : undefined}>
        {value}
        {unit !== undefined && <span class="unit">{unit}</span>}
      </span>
    </div>
  );
}

interface NumbersProps {
  readonly name: string;
  /** Name of each number, for screen readers: "mu", "mu2". */
  readonly labels: readonly string[];
  readonly values: readonly number[];
  readonly decimals?: number;
  readonly unit?: string;
  readonly min?: number;
  readonly max?: number;
  readonly onCommit: (index: number, value: number) => void;
  /** Called when Enter is pressed in a number, after it is committed. */
  readonly onEnter?: () => void;
}

export function NumbersRow(props: NumbersProps): JSX.Element {
  const { name, labels, values, decimals, unit, min, max, onCommit, onEnter } = props;
  const isSingle = labels.length === 1;
  return (
    <div class="kv numbers">
      <span>
        {name}
        {!isSingle && unit !== undefined && <span class="unit">{unit}</span>}
      </span>
      <span>
        {labels.map((label, index) => (
          <NumberField
            key={label}
            label={label}
            value={values[index] ?? 0}
            {...(decimals === undefined ? {} : { decimals })}
            unit={isSingle ? unit : undefined}
            min={min}
            max={max}
            class="small num"
            onCommit={(value) => onCommit(index, value)}
            onEnter={onEnter}
          />
        ))}
      </span>
    </div>
  );
}
