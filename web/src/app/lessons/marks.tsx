/** Marks of a lesson's step: rings around parts of the page, outlines of models in the scene. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useLayoutEffect } from "preact/hooks";

import { findModel } from "../../page/selection_lookup";
import { bodiesOf } from "../../page/world_nodes";
import type { LessonStep } from "../../protocol/generated/page_messages";
import type { Outlined } from "../../scene/world/selection_outline";
import type { Shell } from "../shell";

type PagePart = LessonStep["parts"][number];
type Box = readonly [number, number, number, number];

const ON_SCENE: Partial<Readonly<Record<PagePart, string>>> = {
  play: ".bar .b.pri, .bar .b.line",
  clock: ".bar .read",
  reset: '.bar [data-part="reset"]',
  tools: ".tools",
  drive: ".drive .disc",
  cameras: ".tiles",
};
/** Distance of a ring from its part [px]. */
const AROUND = 3;
const PERIOD = 200; // ms

/** Selectors for a part, the best first: the part itself, then controls that open or uncover it. */
function selectorsOf(part: PagePart): readonly string[] {
  const own = ON_SCENE[part];
  if (own !== undefined) return [own, ".bar .more", ".sheet .grab"];
  return [`.panel [data-tab="${part}"]`, `[data-tab-panel-id="${part}"]`, '.dock [aria-label="Open a panel"]'];
}

/** Box of a part's first visible element. */
function boxOf(part: PagePart): Box | null {
  for (const selector of selectorsOf(part)) {
    const element = document.querySelector(selector);
    if (element === null) continue;
    const { left, top, width, height } = element.getBoundingClientRect();
    if (width > 0 && height > 0 && !isCovered(element, left + width / 2, top + height / 2))
      return [left, top, width, height];
  }
  return null;
}

/** True if an element's middle lies outside of the window, or below a panel, a sheet or a dialog. */
function isCovered(element: Element, x: number, y: number): boolean {
  const hit = document.elementFromPoint(x, y);
  const above = hit?.closest(".panel, .sheet, dialog");
  return hit === null || (above != null && !above.contains(element));
}

/** Rings around the parts of the step. */
export function Rings({ shell }: { readonly shell: Shell }): JSX.Element {
  const parts = shell.lessons.step.value?.parts;
  const boxes = useSignal<readonly Box[]>([]);
  useLayoutEffect(() => {
    const measure = (): void => {
      const found = (parts ?? []).map(boxOf).filter((box) => box !== null);
      if (String(found) !== String(boxes.peek())) boxes.value = found;
    };
    measure();
    if (parts === undefined || parts.length === 0) return;
    const timer = setInterval(measure, PERIOD);
    return () => clearInterval(timer);
  }, [parts, boxes]);
  return (
    <>
      {boxes.value.map(([left, top, width, height], index) => (
        <div
          key={index}
          class="lesson-ring"
          aria-hidden="true"
          style={{
            left: `${left - AROUND}px`,
            top: `${top - AROUND}px`,
            width: `${width + 2 * AROUND}px`,
            height: `${height + 2 * AROUND}px`,
          }}
        />
      ))}
    </>
  );
}

/** Outlines of the step's models. */
export function lessonOutlines({ page, lessons }: Shell): readonly Outlined[] {
  const thin = (lessons.step.value?.models ?? []).flatMap((name) => {
    const model = findModel(page, name);
    return model === null ? [] : bodiesOf(model);
  });
  return thin.length === 0 ? [] : [{ thin, broad: [], color: "--warn" }];
}
