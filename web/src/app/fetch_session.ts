/** The session, which the page asks for before its scripts are there. */

import type { Session } from "../page/session";

/** Fetch what the page is for; throws a sentence. */
export async function fetchSession(address: string): Promise<Session> {
  const url = new URL("session.json", address);
  url.search = new URL(address).search; // the token
  const response = await fetch(url);
  if (!response.ok) throw new Error(`The page's server refuses: ${response.status} ${await response.text()}`);
  return (await response.json()) as Session;
}
