/** Position of an inserted item, typed where there is no 3D view to click in. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { Vector3 } from "three";

import type { Insertable } from "../../page/insertable";
import { withNumber } from "../../page/request_fields";
import { Button } from "../../theme/button";
import { NumberField } from "../../theme/number_field";
import type { Shell } from "../shell";

const FARTHEST = 1e6; // m

export function TypedPosition({ shell, item }: { readonly shell: Shell; readonly item: Insertable }): JSX.Element {
  const { insertion } = shell;
  const position = useSignal<readonly [number, number, number]>([0, 0, 0]);
  return (
    <section class="typed" aria-label={`Position of the ${item.title}`}>
      <p class="sm t2">There is no 3D view to click in: type the position of the {item.title}.</p>
      <div class="axes3">
        {position.value.map((value, index) => (
          <span key={index} class="cell">
            <NumberField
              label={`Position ${"xyz"[index] ?? ""}`}
              unit="m"
              value={value}
              min={-FARTHEST}
              max={FARTHEST}
              class="num"
              before={
                <span class="axis" style={{ "--ax": `var(--${"xyz"[index] ?? ""})` }}>
                  {"xyz"[index]}
                </span>
              }
              onCommit={(number) => (position.value = withNumber(position.value, index, number))}
            />
          </span>
        ))}
      </div>
      <div class="acts">
        <span class="sp" />
        <Button onClick={() => (insertion.typed.value = null)}>Cancel</Button>
        <Button
          tone="primary"
          onClick={() => {
            insertion.typed.value = null;
            insertion.place(item, new Vector3(...position.value));
          }}
        >
          Insert
        </Button>
      </div>
    </section>
  );
}
