/** Notes in place of the scene or over it: loading, an empty world, a browser without WebGL. */

import type { JSX } from "preact";

import { fixed } from "../../theme/format";
import { Name } from "../../theme/name";
import type { Shell } from "../shell";
import { WithoutWebGl } from "./without_webgl";

export function SceneNotes({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const status = shell.page.scene.status.value;
  if (status.kind === "unsupported") return <WithoutWebGl shell={shell} reason={status.reason} />;
  if (status.kind === "lost")
    return <Note text="The graphics context was lost; the browser may restore it, or load the page again." />;
  return <Loading shell={shell} />;
}

function Note({ text }: { readonly text: string }): JSX.Element {
  return (
    <p class="scene-note float" role="status">
      {text}
    </p>
  );
}

function Loading({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const { world, session, connection } = shell.page;
  const manifest = world.manifest.value;
  const progress = world.progress.value;
  if (session.kind === "graph" || session.kind === "bag" || connection.state.value.kind === "lost") return null;
  if (manifest?.models.length === 0) return <Note text="The world is empty." />;
  if (manifest !== null && progress >= 1 && world.isDrawn.value) return null;
  const name = manifest === null || manifest.name === "default" ? session.title : manifest.name;
  return (
    <div class="scene-note float loading" role="status">
      <Name text={`Loading ${name}`} />
      <span class="t2">{manifest === null ? "" : `${fixed(progress * 100, 0)} %`}</span>
      <progress aria-label="Loading the world" value={manifest === null ? undefined : progress} />
    </div>
  );
}
