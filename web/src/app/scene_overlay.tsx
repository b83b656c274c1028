/** Overlays of the scene's free part: tools, notices, camera tiles, drive. */

import type { JSX } from "preact";

import { CameraTiles } from "./cameras/tiles";
import { DriveView } from "./drive/view";
import { NoticeLine } from "./notices/line";
import { SceneNotes } from "./notices/scene_notes";
import { ObjectMenu } from "./object_menu/object_menu";
import type { Shell } from "./shell";
import { ToolBar, ToolHint } from "./tool_bar";
import { VideoNotes } from "./video/video_note";
import { FollowOffer } from "./views/follow_offer";
import { ViewMenu } from "./views/view_menu";

export function SceneOverlay({ shell }: { readonly shell: Shell }): JSX.Element {
  const hasTools = !shell.layout.isPhone.value && shell.isDrawn.value; // tools need a drawn scene
  return (
    <section class="scene-overlay" aria-label="Controls of the 3D view">
      <div class="top">
        {hasTools && (
          <div class="bars">
            <ToolBar shell={shell} />
            <ViewMenu shell={shell} />
          </div>
        )}
        <NoticeLine shell={shell} />
        <VideoNotes shell={shell} />
        {shell.isDrawn.value && <FollowOffer shell={shell} />}
        {hasTools && <ToolHint shell={shell} />}
      </div>
      <SceneNotes shell={shell} />
      <CameraTiles shell={shell} />
      <DriveView shell={shell} />
      <ObjectMenu shell={shell} />
    </section>
  );
}
