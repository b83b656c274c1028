/** rviz/Image: the pictures of a topic. */

import { computed } from "@preact/signals";

import type { DisplayContext } from "./display";
import { PictureDisplay } from "./pictures/picture_display";
import { isNumeric } from "./pictures/pixels";
import { BoolProperty, IntProperty, NumberProperty } from "../rviz/properties";
import { register } from "./registry";

export class ImageDisplay extends PictureDisplay {
  readonly className = "rviz/Image";
  readonly picture = computed(() => this.stream.value?.picture.value ?? null);
  private readonly hasNumbers = computed(() => isNumeric(this.stream.value?.encoding.value ?? ""));
  readonly normalize: BoolProperty;
  readonly min: NumberProperty;
  readonly max: NumberProperty;
  readonly window: IntProperty;

  constructor(context: DisplayContext) {
    super(context);
    const { hasNumbers } = this;
    const isFixed = computed(() => hasNumbers.value && !this.normalize.value.value);
    const isAutomatic = computed(() => hasNumbers.value && this.normalize.value.value);
    this.normalize = this.add(
      new BoolProperty("Normalize Range", true, {
        visible: hasNumbers,
        description: "Black and white are the smallest and largest values of the images.",
      }),
    );
    this.min = this.add(new NumberProperty("Min Value", 0, { visible: isFixed, description: "Value that is black." }));
    this.max = this.add(new NumberProperty("Max Value", 1, { visible: isFixed, description: "Value that is white." }));
    this.window = this.add(
      new IntProperty("Median window", 5, {
        visible: isAutomatic,
        min: 1,
        description: "Images whose median range is used.",
      }),
    );
  }

  protected override onStart(): void {
    super.onStart();
    this.whileEnabled(() => {
      const normalization = {
        isAutomatic: this.normalize.value.value,
        min: this.min.value.value,
        max: this.max.value.value,
        window: this.window.value.value,
      };
      if (this.stream.value !== null) this.stream.value.normalization = normalization;
    });
  }
}

register({
  className: "rviz/Image",
  aliases: [],
  types: ["sensor_msgs/Image", "sensor_msgs/CompressedImage"],
  create: (context) => new ImageDisplay(context),
});
