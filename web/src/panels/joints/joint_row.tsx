/** Slider of a joint with its name, value and limits. */

import type { JSX } from "preact";

import { fixed } from "../../theme/format";
import { Name } from "../../theme/name";
import { NumberField } from "../../theme/number_field";
import { Slider } from "../../theme/slider";
import { shownUnit, type JointSlider } from "./joint_sliders";

interface JointRowProps {
  readonly slider: JointSlider;
  readonly isDegrees: boolean;
}

export function JointRow({ slider, isDegrees }: JointRowProps): JSX.Element {
  const [factor, unit] = shownUnit(slider.isLinear, isDegrees);
  const decimals = unit === "°" ? 1 : 3;
  const text = (value: number): string => fixed(value * factor, decimals);
  return (
    <div class="joint">
      <div class="w">
        <Name text={slider.name} />
        <span class="sp" />
        <span class="narrow">
          <NumberField
            label={slider.name}
            unit={unit}
            class="small num bare"
            value={slider.position * factor}
            decimals={decimals}
            min={slider.hasLimits ? slider.lower * factor : undefined}
            max={slider.hasLimits ? slider.upper * factor : undefined}
            onCommit={(value) => slider.set(value / factor)}
          />
        </span>
      </div>
      <Slider
        label={slider.name}
        value={slider.position}
        lower={slider.lower}
        upper={slider.upper}
        text={`${text(slider.position)} ${unit}`}
        onInput={slider.set}
      />
      <div class="limits">
        {slider.hasLimits ? (
          <>
            <span>{text(slider.lower)}</span>
            <span>{text(slider.upper)}</span>
          </>
        ) : (
          <span>no limits</span>
        )}
      </div>
    </div>
  );
}
