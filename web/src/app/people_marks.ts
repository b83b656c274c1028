/** Selections of other people in the scene: an outline in their color, and their name. */

import { effect, untracked } from "@preact/signals";

import type { Outlined } from "../scene/world/selection_outline";
import type { Page } from "../page/page";
import { colorOf, nameOf, others } from "../page/people";
import { selectedBodies } from "../page/selection_lookup";

/** An outline for each other person who has selected something. */
export function othersOutlines(page: Page): readonly Outlined[] {
  return others(page.people.value)
    .map((person): Outlined => ({ thin: selectedBodies(page, person.selection), broad: [], color: colorOf(person) }))
    .filter(({ thin }) => thin.length > 0);
}

/** Keep each person's name at their selection. */
export function labelOthers(page: Page): void {
  effect(() => {
    page.world.progress.value; // eslint-disable-line @typescript-eslint/no-unused-expressions -- also labels models that are loaded later
    const shown = others(page.people.value).flatMap((person) => {
      const [body] = selectedBodies(page, person.selection);
      const anchor = body === undefined ? null : page.world.object(body);
      return anchor === null ? [] : [{ anchor, person }];
    });
    const labels = untracked(() =>
      shown.map(({ anchor, person }) => page.scene.addLabel(anchor, nameOf(person), colorOf(person))),
    );
    return () => labels.forEach((label) => label.remove());
  });
}
