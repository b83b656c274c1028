/** Compares the page with a recording on the person's machine: a world with a state log, topics with a bag. */

import { sentence } from "../panels/use";
import { read } from "../protocol/check";
import { uploadedRecording } from "../protocol/generated/page_checks";
import { canControl } from "../page/view_only";
import type { Command, Page } from "../page/page";
import { postForm } from "./post_form";
import type { Shell } from "./shell";

const TITLE = "Compare";
const LOG = ".log";
const BAGS = [".bag", ".mcap"];

export function compareCommands(shell: Shell): readonly Command[] {
  const { page } = shell;
  if (kinds(page).length === 0) return [];
  const isConnected = (): boolean => page.connection.state.peek().kind === "connected" && canControl(page);
  return [
    {
      id: "compare",
      title: "Compare with a recording…",
      group: "Simulation",
      enabled: isConnected,
      run: () => choose(shell),
    },
    {
      id: "compare.stop",
      title: "Stop comparing",
      group: "Simulation",
      enabled: () => isConnected() && page.world.referenceInfo.peek() !== null,
      run: () => shell.request(TITLE, "stop_comparing", {}),
    },
  ];
}

/** True if a file that was dropped is a recording to compare with. */
export function isRecording(page: Page, file: File): boolean {
  return kinds(page).some((kind) => file.name.toLowerCase().endsWith(kind)) && canControl(page);
}

/** Send a recording to the server, and show the differences from it. */
export async function compareWith(shell: Shell, file: File): Promise<void> {
  const form = new FormData();
  form.append(file.name, file);
  try {
    const answer = await postForm(`reference${location.search}`, form, new AbortController().signal, () => undefined);
    read(answer, "the answer to the upload", uploadedRecording);
    shell.dock.open("compare");
  } catch (error) {
    shell.notices.report(TITLE, sentence(error));
  }
}

/** Endings of the names of recordings that the page can be compared with. */
function kinds({ session }: Page): readonly string[] {
  const hasTopics = session.kind === "bag" || session.node !== null;
  return [...(session.kind === "simulation" || session.kind === "log" ? [LOG] : []), ...(hasTopics ? BAGS : [])];
}

function choose(shell: Shell): void {
  const input = Object.assign(document.createElement("input"), { type: "file", accept: kinds(shell.page).join(",") });
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    if (file !== undefined) void compareWith(shell, file);
  });
  input.click();
}
