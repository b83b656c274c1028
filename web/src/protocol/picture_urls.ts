/** Addresses of pictures that the server draws. */

import type { RenderModel, RenderView } from "./generated/page_messages";

interface Pictures {
  readonly "camera.png": RenderView;
  readonly "model.png": Omit<RenderModel, "kind">;
  /** The shape of a model. */
  readonly "model.glb": Omit<RenderModel, "kind">;
}

/** Address of a picture; `version` avoids the browser's cached copy of an earlier one. */
export function pictureUrl<F extends keyof Pictures>(file: F, request: Pictures[F], version?: number): string {
  const fields = Object.entries({ ...request, ...(version === undefined ? {} : { version }) });
  return `${file}?${new URLSearchParams(fields.map(([name, value]) => [name, String(value)])).toString()}`;
}
