/** Compares the world with a recording on the person's machine: a state log, chosen or dropped. */

import { sentence } from "../panels/use";
import { read } from "../protocol/check";
import { uploadedRecording } from "../protocol/generated/page_checks";
import { canControl } from "../page/looking";
import type { Command, Page } from "../page/page";
import { postForm } from "./post_form";
import type { Shell } from "./shell";

const TITLE = "Compare";
const LOG = /\.log$/i;

export function compareCommands(shell: Shell): readonly Command[] {
  const { page } = shell;
  if (!isComparable(page)) return [];
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
      enabled: () => isConnected() && (page.world.manifest.peek()?.reference ?? null) !== null,
      run: () => shell.request(TITLE, "stop_comparing", {}),
    },
  ];
}

/** True if a file that was dropped is a recording to compare with. */
export function isRecording(page: Page, file: File): boolean {
  return LOG.test(file.name) && isComparable(page) && canControl(page);
}

/** Send a state log to the server, and show the differences from it. */
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

function isComparable({ session }: Page): boolean {
  return session.kind === "simulation" || session.kind === "log";
}

function choose(shell: Shell): void {
  const input = Object.assign(document.createElement("input"), { type: "file", accept: ".log" });
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    if (file !== undefined) void compareWith(shell, file);
  });
  input.click();
}
