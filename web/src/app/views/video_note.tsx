/** What stands over the scene while a video of it is recorded. */

import type { JSX } from "preact";

import { saveFile, sentence, useTick } from "../../panels/use";
import { Button } from "../../theme/button";
import { fixed } from "../../theme/format";
import type { Shell } from "../shell";

export function VideoNote({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const since = shell.video.since.value;
  useTick(500, since !== null);
  if (since === null) return null;
  return (
    <div class="notice float" role="status">
      <span class="n">Recording a video, {fixed((performance.now() - since) / 1000, 0)} s</span>
      <Button small tone="line" onClick={() => toggleVideo(shell)}>
        Stop and save
      </Button>
    </div>
  );
}

/** Begin a video of the view, or end it and hand it to the person. */
export function toggleVideo({ video, page, notices }: Shell): void {
  const complain = (error: unknown): void => notices.report("Video", sentence(error));
  if (video.since.peek() !== null) {
    video.stop().then(({ content, suffix }) => saveFile(`${page.session.title}.${suffix}`, content), complain);
    return;
  }
  try {
    video.start();
  } catch (error) {
    complain(error);
  }
}
