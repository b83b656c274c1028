/** Menu of the inspected object's values; each entry starts or stops a plot. */

import type { JSX } from "preact";

import { plotsState } from "../../panels/plots/plots_state";
import { plottedValues } from "../../panels/plots/simulated_values";
import { MenuButton } from "../../theme/menu";
import type { Shell } from "../shell";

interface PlotMenuProps {
  readonly shell: Shell;
  /** `model::link`, or a joint's. */
  readonly owner: string;
  /** Names of values, as `pose.x`. */
  readonly values: readonly string[];
}

export function PlotMenu({ shell, owner, values }: PlotMenuProps): JSX.Element | null {
  const { page, dock } = shell;
  const plotted = plottedValues(values, page.session.kind);
  if (plotted.length === 0) return null;
  const state = plotsState(page);
  return (
    <MenuButton
      icon="plots"
      class="sml"
      label={`Plot of ${owner}`}
      items={() =>
        plotted.map((value) => {
          const path = `${owner}.${value}`;
          const curve = state.curves.find((other) => other.path === path);
          return {
            title: value,
            checked: curve !== undefined,
            stays: true,
            run: () => {
              if (curve !== undefined) {
                state.remove(curve);
                return;
              }
              state.add(path);
              dock.open("plots");
            },
          };
        })
      }
    />
  );
}
