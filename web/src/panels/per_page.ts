/** State of a panel that outlives its component: one per page. */

import type { Page } from "../page/page";

/** Returns the page's own instance, created at its first use. */
export function perPage<T>(create: (page: Page) => T): (page: Page) => T {
  const instances = new WeakMap<Page, T>();
  return (page) => {
    const known = instances.get(page);
    if (known !== undefined) return known;
    const created = create(page);
    instances.set(page, created);
    return created;
  };
}
