/** Note over the scene while a video is recorded. */

import type { JSX } from "preact";

import { Button } from "../../theme/button";
import { clock } from "../../theme/format";
import type { Shell } from "../shell";
import type { RunningVideo } from "./videos";

export function VideoNotes({ shell }: { readonly shell: Shell }): JSX.Element {
  return (
    <>
      {shell.videos.running.value.map((video) => (
        <VideoNote key={video.topic} shell={shell} video={video} />
      ))}
    </>
  );
}

function VideoNote({ shell, video }: { readonly shell: Shell; readonly video: RunningVideo }): JSX.Element {
  const { seconds, remark } = video.recording;
  const more = remark.value === "" ? "" : `, ${remark.value}`;
  return (
    <div class="notice float video" role="status">
      <span class="dot" />
      <span class="said">
        Recording {video.title} {clock(Math.floor(seconds.value), 0)}
        {more}
      </span>
      <span class="sp" />
      <Button small tone="line" onClick={() => void shell.videos.save(video)}>
        Stop and save
      </Button>
    </div>
  );
}
