/** Hands the person a replay of the last minutes, which opens without Trundle. */

import { saveFile } from "../../panels/use";
import type { Shell } from "../shell";

export async function saveReplay({ page, notices }: Shell): Promise<void> {
  try {
    const view = JSON.stringify(page.views.current.peek().save());
    const { html = "" } = await page.connection.request("replay", { view });
    saveFile(`${page.session.title}.html`, new Blob([html], { type: "text/html" }));
  } catch (error) {
    notices.report("Replay", error instanceof Error ? error.message : String(error));
  }
}
