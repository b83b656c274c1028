/** Rows of a part's form: each shows and sets a value or its default. */

import type { JSX } from "preact";

import type { DraftField } from "../../protocol/generated/page_messages";
import { Checkbox } from "../../theme/checkbox";
import { parseNumber, plain } from "../../theme/format";
import { numberFault } from "../../theme/number_field";
import { Select } from "../../theme/select";
import { TextField } from "../../theme/text_field";
import type { FieldValue } from "../../scene/draft";

const DEGREE = Math.PI / 180;
const XYZ = ["x", "y", "z"] as const;
const ANGLES = ["roll", "pitch", "yaw"] as const;

interface RowProps {
  readonly field: DraftField;
  readonly onSet: (value: FieldValue) => void;
}

export function FieldRow({ field, onSet }: RowProps): JSX.Element {
  switch (field.kind) {
    case "pose":
      return <PoseRows field={field} onSet={onSet} />;
    case "vector":
    case "number":
      return <NumberRow field={field} onSet={onSet} />;
    case "color":
      return <ColorRow field={field} onSet={onSet} />;
    case "flag":
      return <FlagRow field={field} onSet={onSet} />;
    case "choice":
      return <ChoiceRow field={field} onSet={onSet} />;
    case "text":
      return <TextRow field={field} onSet={onSet} />;
  }
}

function numbersOf(value: DraftField["value"]): readonly number[] | null {
  return Array.isArray(value) ? (value as readonly number[]) : null;
}

/** Numbers of which one is set; null leaves a number as it is. */
function only(length: number, index: number, value: number): readonly (number | null)[] {
  return Array.from({ length }, (_, i) => (i === index ? value : null));
}

interface CellProps {
  readonly label: string;
  readonly unit?: string | undefined;
  /** Null: the default is used. */
  readonly value: number | null;
  readonly placeholder: string;
  readonly min?: number | undefined;
  readonly max?: number | undefined;
  readonly before?: string;
  readonly onSet: (value: number | null) => void;
}

/** Cell of a number; empty, it has its default. */
function NumberCell({ label, unit, value, placeholder, min, max, before, onSet }: CellProps): JSX.Element {
  return (
    <span class="cell">
      <TextField
        label={unit === undefined ? label : `${label} [${unit}]`}
        value={value === null ? "" : plain(value)}
        placeholder={placeholder}
        check={(text) => (text.trim() === "" ? null : numberFault(text, { min, max }))}
        class="small num"
        before={before === undefined ? null : <span class="axis" style={{ "--ax": `var(--${before})` }} />}
        onCommit={(text) => {
          const number = parseNumber(text);
          if (text.trim() === "" || number !== null) onSet(number);
        }}
      />
    </span>
  );
}

function NumberRow({ field, onSet }: RowProps): JSX.Element {
  const { label, unit, labels, minimum: min, maximum: max } = field;
  const values = numbersOf(field.value);
  const defaults = numbersOf(field.default);
  const names = labels ?? [""];
  const set = (index: number, value: number | null): void => {
    onSet(value === null ? null : only(names.length, index, value));
  };
  return (
    <div class="fr">
      <span class="k">
        {label}
        {unit !== undefined && <span class="unit">{unit}</span>}
      </span>
      <span class={`cells n${names.length}`}>
        {names.map((name, index) => (
          <NumberCell
            key={name}
            label={name === "" ? label : `${label} ${name}`}
            unit={unit}
            value={values?.[index] ?? null}
            placeholder={defaults?.[index] === undefined ? "none" : plain(defaults[index])}
            min={min}
            max={max}
            {...(names.length === 3 ? { before: XYZ[index] ?? "x" } : {})}
            onSet={(value) => set(index, value)}
          />
        ))}
      </span>
    </div>
  );
}

function PoseRows({ field, onSet }: RowProps): JSX.Element {
  const pose = numbersOf(field.value) ?? numbersOf(field.default) ?? [0, 0, 0, 0, 0, 0];
  const set = (index: number, value: number | null): void => onSet(only(pose.length, index, value ?? 0));
  const row = (title: string, unit: string, names: readonly string[], first: number, scale: number): JSX.Element => (
    <div class="fr">
      <span class="k">
        {title}
        <span class="unit">{unit}</span>
      </span>
      <span class="cells n3">
        {names.map((name, index) => (
          <NumberCell
            key={name}
            label={`${field.label} ${name}`}
            unit={unit}
            value={(pose[first + index] ?? 0) / scale}
            placeholder="0"
            min={field.minimum}
            max={field.maximum}
            before={XYZ[index] ?? "x"}
            onSet={(value) => set(first + index, value === null ? null : value * scale)}
          />
        ))}
      </span>
    </div>
  );
  return (
    <>
      {row(field.label, "m", XYZ, 0, 1)}
      {row("Roll pitch yaw", "°", ANGLES, 3, DEGREE)}
    </>
  );
}

function ColorRow({ field, onSet }: RowProps): JSX.Element {
  const [red = 0.7, green = 0.7, blue = 0.7, alpha = 1] = numbersOf(field.value) ?? numbersOf(field.default) ?? [];
  return (
    <div class="fr">
      <span class="k">{field.label}</span>
      <span class="cells n2">
        <input
          type="color"
          class="sw"
          aria-label={field.label}
          value={hex([red, green, blue])}
          onChange={(event) => onSet([...rgb(event.currentTarget.value), alpha])}
        />
        <NumberCell
          label={`${field.label} alpha`}
          value={alpha}
          placeholder="1"
          min={0}
          max={1}
          onSet={(value) => onSet([red, green, blue, value ?? 1])}
        />
      </span>
    </div>
  );
}

function hex(parts: readonly number[]): string {
  return `#${parts
    .map((part) =>
      Math.round(255 * part)
        .toString(16)
        .padStart(2, "0"),
    )
    .join("")}`;
}

function rgb(text: string): readonly number[] {
  return [1, 3, 5].map((at) => Math.round(1000 * (parseInt(text.slice(at, at + 2), 16) / 255)) / 1000);
}

function FlagRow({ field, onSet }: RowProps): JSX.Element {
  return (
    <label class="fr">
      <span class="k">{field.label}</span>
      <span class="cells">
        <Checkbox
          label={field.label}
          checked={(field.value ?? field.default) === true}
          onChange={(on) => onSet(String(on))}
        />
      </span>
    </label>
  );
}

function ChoiceRow({ field, onSet }: RowProps): JSX.Element {
  const value = typeof field.value === "string" ? field.value : typeof field.default === "string" ? field.default : "";
  return (
    <div class="fr">
      <span class="k">{field.label}</span>
      <span class="cells">
        <Select label={field.label} value={value} choices={field.choices ?? []} onChange={onSet} />
      </span>
    </div>
  );
}

function TextRow({ field, onSet }: RowProps): JSX.Element {
  const placeholder = typeof field.default === "string" ? field.default : "";
  return (
    <div class="fr wide">
      <span class="k" data-tip={field.label.length > 14 ? field.label : undefined}>
        {field.label}
      </span>
      <span class="cells">
        <TextField
          label={field.label}
          value={typeof field.value === "string" ? field.value : ""}
          placeholder={placeholder}
          class="small"
          onCommit={(text) => onSet(text.trim() === "" && field.name !== "@name" ? null : text.trim())}
        />
      </span>
    </div>
  );
}
