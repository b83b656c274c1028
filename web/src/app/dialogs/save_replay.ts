/** Hands the person the last minutes, as a page or a glTF file that opens without Trundle. */

import { saveFile } from "../../panels/use";
import type { Shell } from "../shell";

export async function saveReplay({ page, notices }: Shell, format: "html" | "glb"): Promise<void> {
  try {
    const view = JSON.stringify(page.views.current.peek().save());
    const answer = await page.connection.request("replay", { view, format });
    const content =
      "html" in answer
        ? new Blob([answer.html], { type: "text/html" })
        : new Blob([bytesOf(answer.glb)], { type: "model/gltf-binary" });
    saveFile(`${page.session.title}.${format}`, content);
  } catch (error) {
    notices.report("Replay", error instanceof Error ? error.message : String(error));
  }
}

function bytesOf(base64: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
}
