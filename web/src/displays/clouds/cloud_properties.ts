/** Properties of rviz's clouds, in rviz's order: those of all styles, then those of each color transformer. */

import { computed, type ReadonlySignal } from "@preact/signals";

import { BoolProperty, ColorProperty, EnumProperty, NumberProperty, type Property } from "../../rviz/properties";
import { touch } from "../topic_display";
import { COLOR_TRANSFORMERS } from "./cloud_colors";
import { STYLES } from "./cloud_material";

/** A cloud whose channel and colors the display's class sets: Temperature and its kin. */
export interface FixedChannel {
  readonly channel: string;
  readonly min: number;
  readonly max: number;
  readonly invert: boolean;
}

type Visible = ReadonlySignal<boolean>;

export class CloudProperties {
  readonly selectable = new BoolProperty("Selectable", true);
  readonly style = new EnumProperty("Style", "Flat Squares", STYLES);
  private readonly inPixels = computed(() => this.style.value.value === "Points");
  private readonly inMetres = computed(() => !this.inPixels.value);
  readonly size = new NumberProperty("Size (m)", 0.01, { min: 0.0001, unit: "m", visible: this.inMetres });
  readonly pixels = new NumberProperty("Size (Pixels)", 3, { min: 1, unit: "px", visible: this.inPixels });
  readonly alpha = new NumberProperty("Alpha", 1, { min: 0, max: 1 });
  readonly decay = new NumberProperty("Decay Time", 0, {
    min: 0,
    unit: "s",
    description: "How long points stay; 0 shows only the latest.",
  });
  readonly position: EnumProperty;
  readonly color: EnumProperty;
  readonly axis: EnumProperty;
  readonly autoValues: BoolProperty;
  readonly minValue: NumberProperty;
  readonly maxValue: NumberProperty;
  readonly inFixedFrame: BoolProperty;
  readonly flatColor: ColorProperty;
  readonly channel: EnumProperty;
  readonly useRainbow: BoolProperty;
  readonly invertRainbow: BoolProperty;
  readonly minColor: ColorProperty;
  readonly maxColor: ColorProperty;
  readonly autoIntensity: BoolProperty;
  readonly minIntensity: NumberProperty;
  readonly maxIntensity: NumberProperty;

  constructor(fixed?: FixedChannel) {
    const isFree = fixed === undefined;
    const free = (visible: () => boolean): Visible => computed(() => isFree && visible());
    this.position = new EnumProperty("Position Transformer", "", ["XYZ"], { open: true, visible: free(() => true) });
    this.color = new EnumProperty("Color Transformer", "", COLOR_TRANSFORMERS, {
      open: true,
      visible: free(() => true),
    });
    const shows = (name: string): boolean => this.color.value.value === name;

    const byAxis = computed(() => shows("AxisColor"));
    const fixedValues = computed(() => byAxis.value && !this.autoValues.value.value);
    this.axis = new EnumProperty("Axis", "Z", ["X", "Y", "Z"], { visible: byAxis });
    this.autoValues = new BoolProperty("Autocompute Value Bounds", true, { visible: byAxis });
    this.minValue = this.autoValues.add(new NumberProperty("Min Value", -10, { visible: fixedValues, unit: "m" }));
    this.maxValue = this.autoValues.add(new NumberProperty("Max Value", 10, { visible: fixedValues, unit: "m" }));
    this.inFixedFrame = new BoolProperty("Use Fixed Frame", true, { visible: byAxis });

    this.flatColor = new ColorProperty("Color", [255, 255, 255], { visible: computed(() => shows("FlatColor")) });

    const byIntensity = computed(() => shows("Intensity"));
    const rainbow = (): boolean => this.useRainbow.value.value;
    const twoColors = computed(() => byIntensity.value && !rainbow());
    const bounded = computed(() => byIntensity.value && !this.autoIntensity.value.value);
    this.channel = new EnumProperty("Channel Name", fixed?.channel ?? "intensity", [], {
      open: true,
      visible: free(() => byIntensity.value),
    });
    this.useRainbow = new BoolProperty("Use rainbow", true, { visible: byIntensity });
    this.invertRainbow = new BoolProperty("Invert Rainbow", fixed?.invert ?? false, {
      visible: computed(() => byIntensity.value && rainbow() && !(fixed?.invert ?? false)),
    });
    this.minColor = new ColorProperty("Min Color", [0, 0, 0], { visible: twoColors });
    this.maxColor = new ColorProperty("Max Color", [255, 255, 255], { visible: twoColors });
    this.autoIntensity = new BoolProperty("Autocompute Intensity Bounds", isFree, {
      visible: free(() => byIntensity.value),
    });
    this.minIntensity = new NumberProperty("Min Intensity", fixed?.min ?? 0, { visible: bounded });
    this.maxIntensity = new NumberProperty("Max Intensity", fixed?.max ?? 4096, { visible: bounded });
  }

  get all(): readonly Property<unknown>[] {
    return [
      this.selectable,
      this.style,
      this.size,
      this.pixels,
      this.alpha,
      this.decay,
      this.position,
      this.color,
      this.axis,
      this.autoValues,
      this.inFixedFrame,
      this.flatColor,
      this.channel,
      this.useRainbow,
      this.invertRainbow,
      this.minColor,
      this.maxColor,
      this.autoIntensity,
      this.minIntensity,
      this.maxIntensity,
    ];
  }

  /** Read the properties that the points' look depends on, except the bounds computed from the points. */
  track(): void {
    const { autoValues, autoIntensity, minValue, maxValue, minIntensity, maxIntensity } = this;
    const set = new Set<Property<unknown>>([minValue, maxValue, minIntensity, maxIntensity, this.decay]);
    for (const property of this.all) if (!set.has(property)) touch(property.value);
    if (!autoValues.value.value) [minValue, maxValue].forEach(({ value }) => touch(value));
    if (!autoIntensity.value.value) [minIntensity, maxIntensity].forEach(({ value }) => touch(value));
  }
}
