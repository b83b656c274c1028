/** Editors of properties, by their kind; every change can be undone. */

import type { JSX } from "preact";

import {
  BoolProperty,
  ColorProperty,
  EnumProperty,
  FIXED_FRAME,
  FrameProperty,
  IntProperty,
  NumberProperty,
  StringProperty,
  TopicProperty,
  VectorProperty,
  type Property,
  type Triple,
  type Yaml,
} from "../../rviz/properties";
import { Checkbox } from "../../theme/checkbox";
import { Combo, type Choice } from "../../theme/combo";
import { parseNumber, plain } from "../../theme/format";
import { NumberField } from "../../theme/number_field";
import { Select } from "../../theme/select";
import { TextField } from "../../theme/text_field";
import { changeProperty } from "../../page/change_property";
import type { Page } from "../../page/page";

export interface EditorProps {
  readonly page: Page;
  readonly property: Property<unknown>;
}

export function PropertyEditor({ page, property }: EditorProps): JSX.Element | null {
  const set = (yaml: Yaml): void => changeProperty(page, property, yaml);
  if (property.options.readOnly === true) return <span class="t2">{shown(property.value.value)}</span>;
  if (property instanceof BoolProperty) {
    return <Checkbox label={property.name} checked={property.value.value} tabIndex={-1} onChange={set} />;
  }
  if (property instanceof NumberProperty) return <NumberEditor property={property} onCommit={set} />;
  if (property instanceof EnumProperty) return <EnumEditor property={property} onCommit={set} />;
  if (property instanceof ColorProperty) return <ColorEditor property={property} onCommit={set} />;
  if (property instanceof VectorProperty) return <VectorEditor property={property} onCommit={set} />;
  if (property instanceof TopicProperty || property instanceof FrameProperty) {
    const choices = (): readonly Choice[] =>
      property instanceof TopicProperty ? topicChoices(page, property.types) : frameChoices(page);
    return <Combo label={property.name} value={property.value.value} choices={choices} onCommit={set} />;
  }
  if (property instanceof StringProperty) {
    return <TextField label={property.name} value={property.value.value} class="small bare" onCommit={set} />;
  }
  return null;
}

interface KindProps<P> {
  readonly property: P;
  readonly onCommit: (yaml: Yaml) => void;
}

function NumberEditor({ property, onCommit }: KindProps<NumberProperty>): JSX.Element {
  const { min, max, unit } = property.options;
  const inName = property.name.includes("(");
  return (
    <NumberField
      label={property.name}
      value={property.value.value}
      unit={inName ? undefined : unit}
      min={min}
      max={max}
      integer={property instanceof IntProperty}
      class="small bare"
      onCommit={onCommit}
    />
  );
}

function EnumEditor({ property, onCommit }: KindProps<EnumProperty>): JSX.Element {
  const choices = property.choices.value;
  if (!property.isOpen)
    return <Select label={property.name} value={property.value.value} choices={choices} onChange={onCommit} />;
  const listed = (): readonly Choice[] => property.choices.peek().map((value) => ({ value }));
  return <Combo label={property.name} value={property.value.value} choices={listed} onCommit={onCommit} />;
}

function ColorEditor({ property, onCommit }: KindProps<ColorProperty>): JSX.Element {
  const rgb = property.value.value;
  return (
    <>
      <input
        type="color"
        class="sw"
        aria-label={`${property.name}, picker`}
        value={hex(rgb)}
        onChange={(event) => onCommit(fromHex(event.currentTarget.value))}
      />
      <TextField
        label={property.name}
        value={rgb.join("; ")}
        class="small bare"
        check={(text) => (colorOf(text) === null ? "Three numbers of 0 to 255: 255; 25; 0" : null)}
        onCommit={(text) => onCommit(colorOf(text) ?? rgb.join("; "))}
      />
    </>
  );
}

function VectorEditor({ property, onCommit }: KindProps<VectorProperty>): JSX.Element {
  const [x, y, z] = property.value.value;
  return (
    <TextField
      label={property.name}
      value={`${plain(x)}; ${plain(y)}; ${plain(z)}`}
      class="small bare"
      check={(text) => (vectorOf(text) === null ? "Three numbers: 0; 0; 0.5" : null)}
      onCommit={(text) => {
        const vector = vectorOf(text);
        if (vector !== null) onCommit({ X: vector[0], Y: vector[1], Z: vector[2] });
      }}
      after={<span class="unit">m</span>}
    />
  );
}

/** Three numbers of a text with `;` or spaces between. */
export function vectorOf(text: string): Triple | null {
  const parts = text
    .split(/[;\s]+/)
    .filter((part) => part !== "")
    .map(parseNumber);
  const [x, y, z] = parts;
  return parts.length === 3 && x != null && y != null && z != null ? [x, y, z] : null;
}

/** Color as `r; g; b`, from a text in that form or `#rrggbb`; null: neither. */
export function colorOf(text: string): string | null {
  if (/^#[0-9a-f]{6}$/i.test(text.trim())) return fromHex(text.trim());
  const parts = vectorOf(text.replaceAll(",", ";"));
  return parts?.every((part) => part >= 0 && part <= 255) === true ? parts.map(Math.round).join("; ") : null;
}

export function hex(rgb: readonly number[]): string {
  return `#${rgb.map((part) => Math.round(part).toString(16).padStart(2, "0")).join("")}`;
}

function fromHex(text: string): string {
  return [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16)).join("; ");
}

/** Topics that have one of these types; no types: all topics. */
function topicChoices(page: Page, types: readonly string[]): readonly Choice[] {
  return [...page.connection.topics.peek().values()]
    .filter((topic) => types.length === 0 || types.includes(topic.type))
    .map((topic) => ({ value: topic.name, detail: topic.type.split("/")[1] ?? topic.type }))
    .sort((a, b) => a.value.localeCompare(b.value));
}

function frameChoices(page: Page): readonly Choice[] {
  return [FIXED_FRAME, ...page.frames.frames.peek()].map((value) => ({ value }));
}

function shown(value: unknown): string {
  if (typeof value === "number") return plain(value);
  if (Array.isArray(value))
    return value.map((part) => (typeof part === "number" ? plain(part) : String(part))).join("; ");
  return typeof value === "string" ? value : JSON.stringify(value ?? "");
}
