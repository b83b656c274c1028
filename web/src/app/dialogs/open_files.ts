/** Opens files of the person's machine: a chosen .rviz file, or files dropped onto the page. */

import { compareWith, isRecording } from "../compare_recording";
import { droppedModel } from "../insert/model_files";
import type { Shell } from "../shell";
import { canEdit } from "../world/edits";

const RVIZ = /\.(rviz|ya?ml)$/i;

/** Let the person choose a file. */
export function chooseRviz(shell: Shell): void {
  const input = Object.assign(document.createElement("input"), { type: "file", accept: ".rviz,.yaml,.yml" });
  input.addEventListener("change", () => void open(shell, input.files?.[0]));
  input.click();
}

/** Open files dropped onto the page: recordings to compare with, models to insert; returns a function that stops. */
export function acceptDroppedFiles(shell: Shell): () => void {
  const events = new AbortController();
  const hasFile = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") === true;
  const over = (event: DragEvent): void => {
    if (hasFile(event)) event.preventDefault();
  };
  const drop = (event: DragEvent): void => {
    if (!hasFile(event)) return;
    event.preventDefault();
    const { dataTransfer: carried } = event;
    const file = carried?.files[0];
    if (file !== undefined && isRecording(shell.page, file)) void compareWith(shell, file);
    else if (carried !== null && file !== undefined && canEdit(shell) && !RVIZ.test(file.name)) {
      const { upload } = shell.insertion;
      upload.open();
      void upload.send(droppedModel(carried));
    } else void open(shell, file);
  };
  addEventListener("dragover", over, { signal: events.signal });
  addEventListener("drop", drop, { signal: events.signal });
  return () => events.abort();
}

async function open(shell: Shell, file: File | undefined): Promise<void> {
  if (file === undefined) return;
  const { displays } = shell.page;
  const text = await file.text();
  shell.display.value = null;
  for (const fault of displays.load(text)) shell.notices.report(file.name, fault, "warn");
  shell.openedFile.value = { name: file.name, writable: false };
  shell.layout.open("displays");
}
