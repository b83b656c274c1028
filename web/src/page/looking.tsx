/** Pages whose link only allows looking: the server refuses everything else, and the page does not offer it. */

import type { ComponentChildren, JSX } from "preact";

import type { Page } from "./page";

export const LOOKS_ONLY = "This link only allows looking.";

/** True if what is shown may be changed. */
export function canControl({ session }: Pick<Page, "session">): boolean {
  return !session.view_only;
}

/** Controls of what is shown; where the link only allows looking they are off, and a line says why. */
export function Controls({
  page,
  children,
}: {
  readonly page: Page;
  readonly children: ComponentChildren;
}): JSX.Element {
  const isOff = !canControl(page);
  return (
    <fieldset class="controls" disabled={isOff}>
      {isOff && <p class="sm t2 pad">{LOOKS_ONLY}</p>}
      {children}
    </fieldset>
  );
}
