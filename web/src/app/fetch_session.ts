/** The session, which the page asks for before its scripts are there. */

import type { Session } from "../page/session";

/** Fetch what the page is for; throws a sentence. */
export async function fetchSession(address: string): Promise<Session> {
  const url = new URL("session.json", address);
  url.search = new URL(address).search; // which may say that the page only looks
  const response = await fetch(url);
  if (!response.ok) throw new Error(`The page's server refuses: ${response.status} ${await response.text()}`);
  return (await response.json()) as Session;
}

/** The page's address without its token, which a cookie holds from now on; a page that only looks goes on to say so. */
export function cleanAddress(address: string, viewOnly: boolean): string {
  const url = new URL(address);
  url.searchParams.delete("token");
  if (viewOnly) url.searchParams.set("view_only", "");
  return url.href.replace("view_only=", "view_only");
}
