/** Properties of displays, views and tools: rviz's names, kinds and defaults, saved as rviz saves them. */

import { signal, type ReadonlySignal, type Signal } from "@preact/signals";

/** Value in an .rviz file. */
export type Yaml = string | number | boolean | null | readonly Yaml[] | { readonly [key: string]: Yaml };
export type YamlMapping = Readonly<Record<string, Yaml>>;

export interface PropertyOptions {
  readonly description?: string;
  /** Shown only while this is true. */
  readonly visible?: ReadonlySignal<boolean>;
  readonly readOnly?: boolean;
}

/** A named value with properties below it; a row of the displays panel. */
export abstract class Property<T> {
  readonly value: Signal<T>;
  readonly children: Property<unknown>[] = [];
  /** Changes when children come or go. */
  readonly version = signal(0);
  /** Key in the file: the name, except for topics of ROS 2's files. */
  key: string;
  abstract readonly kind: string;

  constructor(
    readonly name: string,
    readonly initial: T,
    readonly options: PropertyOptions = {},
  ) {
    this.value = signal(initial);
    this.key = name;
  }

  /** Add a property below this one and return it. */
  add<P extends Property<unknown>>(child: P): P {
    this.children.push(child);
    this.version.value = this.version.peek() + 1;
    return child;
  }

  /** Remove a child property. */
  remove(child: Property<unknown>): void {
    const index = this.children.indexOf(child);
    if (index < 0) return;
    this.children.splice(index, 1);
    this.version.value = this.version.peek() + 1;
  }

  /** The value as the file has it; undefined: not saved. */
  abstract encode(): Yaml | undefined;
  /** Set the value from the file; false: not of this kind, unchanged. */
  abstract decode(yaml: Yaml): boolean;

  /** The value with the children's values, as rviz nests them: a property with children is a mapping with `Value`. */
  save(): Yaml | undefined {
    const encoded = this.encode();
    if (this.version.value === 0 || this.children.length === 0) return encoded;
    const mapping: Record<string, Yaml> = {};
    for (const child of this.children) {
      const saved = child.save();
      if (saved !== undefined) mapping[child.name] = saved;
    }
    if (encoded !== undefined) mapping["Value"] = encoded;
    return mapping;
  }

  /** Load what `save` or rviz wrote; returns sentences about values that are not understood. */
  load(yaml: Yaml): string[] {
    if (!isMapping(yaml)) return this.decode(yaml) ? [] : [`${this.name}: ${JSON.stringify(yaml)} is no ${this.kind}`];
    const faults: string[] = [];
    const encoded = yaml["Value"];
    if (encoded !== undefined && this.kind !== "group" && !this.decode(encoded)) {
      faults.push(`${this.name}: ${JSON.stringify(encoded)} is no ${this.kind}`);
    } else if (encoded === undefined && this.children.length === 0 && !this.decode(yaml)) {
      faults.push(`${this.name}: ${JSON.stringify(yaml)} is no ${this.kind}`);
    }
    for (const child of this.children) {
      const entry = yaml[child.name];
      if (entry !== undefined) faults.push(...child.load(entry).map((fault) => `${this.name}/${fault}`));
    }
    return faults;
  }
}

export function isMapping(yaml: Yaml | undefined): yaml is YamlMapping {
  return typeof yaml === "object" && yaml !== null && !Array.isArray(yaml);
}

/** A heading without a value. */
export class GroupProperty extends Property<null> {
  readonly kind = "group";
  constructor(name: string, options: PropertyOptions = {}) {
    super(name, null, options);
  }
  encode(): undefined {
    return undefined;
  }
  decode(): boolean {
    return true;
  }
}

export class BoolProperty extends Property<boolean> {
  readonly kind = "boolean";
  encode(): Yaml {
    return this.value.value;
  }
  decode(yaml: Yaml): boolean {
    if (typeof yaml !== "boolean") return false;
    this.value.value = yaml;
    return true;
  }
}

export interface NumberOptions extends PropertyOptions {
  readonly min?: number;
  readonly max?: number;
  readonly unit?: string;
}

export class NumberProperty extends Property<number> {
  readonly kind: string = "number";
  constructor(
    name: string,
    initial: number,
    override readonly options: NumberOptions = {},
  ) {
    super(name, initial, options);
  }
  encode(): Yaml {
    return this.value.value;
  }
  decode(yaml: Yaml): boolean {
    const number = typeof yaml === "string" && yaml.trim() !== "" ? Number(yaml) : yaml;
    if (typeof number !== "number" || !Number.isFinite(number)) return false;
    const { min = -Infinity, max = Infinity } = this.options;
    this.value.value = Math.min(max, Math.max(min, this.round(number)));
    return true;
  }
  protected round(number: number): number {
    return number;
  }
}

export class IntProperty extends NumberProperty {
  override readonly kind = "integer";
  protected override round(number: number): number {
    return Math.round(number);
  }
}

export class StringProperty extends Property<string> {
  readonly kind: string = "string";
  encode(): Yaml {
    return this.value.value;
  }
  decode(yaml: Yaml): boolean {
    if (typeof yaml !== "string" && typeof yaml !== "number" && yaml !== null) return false;
    this.value.value = yaml === null ? "" : String(yaml);
    return true;
  }
}

/** A text that is computed: shown, and never saved. */
export class ReadOut extends Property<string> {
  readonly kind = "text";
  constructor(name: string, initial = "", options: PropertyOptions = {}) {
    super(name, initial, { ...options, readOnly: true });
  }
  encode(): undefined {
    return undefined;
  }
  decode(): boolean {
    return true;
  }
}

/** One of a list of words; `choices` may change while it runs (channels of a cloud). */
export class EnumProperty extends Property<string> {
  readonly kind = "choice";
  readonly choices: Signal<readonly string[]>;
  constructor(
    name: string,
    initial: string,
    choices: readonly string[],
    options: PropertyOptions & { readonly open?: boolean } = {},
  ) {
    super(name, initial, options);
    this.choices = signal(choices);
    this.isOpen = options.open ?? false;
  }
  /** True if words other than the choices are valid values, too. */
  readonly isOpen: boolean;
  encode(): Yaml {
    return this.value.value;
  }
  decode(yaml: Yaml): boolean {
    const word = typeof yaml === "string" ? yaml : JSON.stringify(yaml);
    if (!this.isOpen && !this.choices.value.includes(word)) return false;
    this.value.value = word;
    return true;
  }
}

/** sRGB components 0…255. */
export type Rgb = readonly [number, number, number];

export class ColorProperty extends Property<Rgb> {
  readonly kind = "color";
  encode(): Yaml {
    return this.value.value.join("; ");
  }
  decode(yaml: Yaml): boolean {
    if (typeof yaml !== "string") return false;
    const [red = NaN, green = NaN, blue = NaN] = yaml.split(";").map(Number);
    if (![red, green, blue].every((part) => part >= 0 && part <= 255)) return false;
    this.value.value = [red, green, blue];
    return true;
  }
}

export type Triple = readonly [number, number, number];

/** X, Y, Z [m]. */
export class VectorProperty extends Property<Triple> {
  readonly kind = "vector";
  encode(): Yaml {
    const [x, y, z] = this.value.value;
    return { X: x, Y: y, Z: z };
  }
  decode(yaml: Yaml): boolean {
    if (!isMapping(yaml)) return false;
    const parts = [yaml["X"], yaml["Y"], yaml["Z"]].map(Number);
    if (!parts.every(Number.isFinite)) return false;
    const [x = 0, y = 0, z = 0] = parts;
    this.value.value = [x, y, z];
    return true;
  }
  override load(yaml: Yaml): string[] {
    return this.decode(yaml) ? [] : [`${this.name}: ${JSON.stringify(yaml)} is no vector`];
  }
}

/** A topic of one of these types. */
export class TopicProperty extends StringProperty {
  override readonly kind = "topic";
  constructor(
    name: string,
    initial: string,
    readonly types: readonly string[],
    options: PropertyOptions = {},
  ) {
    super(name, initial, options);
  }
  /** ROS 2's files have a mapping with the topic's name as `Value`. */
  override load(yaml: Yaml): string[] {
    return isMapping(yaml) && yaml["Value"] !== undefined ? super.load(yaml["Value"]) : super.load(yaml);
  }
}

export const FIXED_FRAME = "<Fixed Frame>";

/** A frame, or `<Fixed Frame>`. */
export class FrameProperty extends StringProperty {
  override readonly kind = "frame";
}
