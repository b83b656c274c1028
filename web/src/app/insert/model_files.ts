/** Files of a model on the person's machine: chosen, or dropped onto the page. */

import { read } from "../../protocol/check";
import { uploadedModels } from "../../protocol/generated/page_checks";
import { postForm, type Progress } from "../post_form";

/** A file, and its path from the folder that was chosen. */
export interface ModelFile {
  readonly path: string;
  readonly file: File;
}

const MAX_FILES = 2000;
/** Largest model that the server accepts [B]. */
const MAX_BYTES = 512 * 1024 * 1024;

/** Let the person choose a file, or a folder with all that is in it. */
export function chooseModel(kind: "file" | "folder", take: (files: readonly ModelFile[]) => void): void {
  const input = Object.assign(document.createElement("input"), { type: "file" });
  if (kind === "folder") input.webkitdirectory = true;
  else input.accept = ".zip,.sdf,.urdf";
  input.addEventListener("change", () =>
    take([...(input.files ?? [])].map((file) => ({ path: file.webkitRelativePath || file.name, file }))),
  );
  input.click();
}

/** Dropped files and folders; the transfer can be read only during the event. */
export function droppedModel(carried: DataTransfer): Promise<readonly ModelFile[]> {
  const entries = [...carried.items].map((item) => item.webkitGetAsEntry()).filter((entry) => entry !== null);
  const files = [...carried.files].map((file) => ({ path: file.name, file }));
  return entries.some(({ isDirectory }) => isDirectory) ? filesBelow(entries) : Promise.resolve(files);
}

async function filesBelow(entries: readonly FileSystemEntry[]): Promise<readonly ModelFile[]> {
  const files: ModelFile[] = [];
  const waiting = [...entries];
  for (let entry = waiting.pop(); entry !== undefined && files.length <= MAX_FILES; entry = waiting.pop()) {
    const { fullPath: path } = entry;
    if (entry.isDirectory) waiting.push(...(await entriesOf(entry as FileSystemDirectoryEntry)));
    else
      files.push({
        path: path.replace(/^\//, ""),
        file: await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject)),
      });
  }
  return files;
}

/** Entries of a folder, which a reader returns in parts. */
async function entriesOf(folder: FileSystemDirectoryEntry): Promise<readonly FileSystemEntry[]> {
  const reader = folder.createReader();
  const all: FileSystemEntry[] = [];
  for (;;) {
    const some = await new Promise<readonly FileSystemEntry[]>((resolve, reject) =>
      reader.readEntries(resolve, reject),
    );
    if (some.length === 0 || all.length > MAX_FILES) return all;
    all.push(...some);
  }
}

/** Name of the chosen file or folder. */
export function titleOf(files: readonly ModelFile[]): string {
  return files[0]?.path.split("/")[0] ?? "";
}

/** Send a model to the server; returns the names of the models in it, or throws a sentence. */
export async function sendModel(
  files: readonly ModelFile[],
  signal: AbortSignal,
  progress: Progress,
): Promise<readonly string[]> {
  if (files.length === 0) throw new Error("there is no file in it");
  if (files.length > MAX_FILES) throw new Error(`it has more than ${MAX_FILES} files`);
  if (files.reduce((sum, { file }) => sum + file.size, 0) > MAX_BYTES)
    throw new Error(`it is too large: a model has at most ${MAX_BYTES / 2 ** 20} MiB`);
  const form = new FormData();
  for (const { path, file } of files) form.append(path, file);
  const answer = await postForm(`models${location.search}`, form, signal, progress);
  return read(answer, "the answer to the upload", uploadedModels).models;
}
