/** View-only pages: the server refuses changes, and the page does not offer them. */

import type { ComponentChildren, JSX } from "preact";

import type { Page } from "./page";

export const VIEW_ONLY = "This link is view-only.";

/** True if the page is not view-only. */
export function canControl({ session }: Pick<Page, "session">): boolean {
  return !session.view_only;
}

/** Controls that change the session; on a view-only page they are disabled, and a line says why. */
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
      {isOff && <p class="sm t2 pad">{VIEW_ONLY}</p>}
      {children}
    </fieldset>
  );
}
