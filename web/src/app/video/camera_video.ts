/** Pictures of a camera for a video, timed by their stamps: in simulated time at any speed. */

import { PictureStream } from "../../displays/pictures/picture_stream";
import type { Connection } from "../../protocol/connection";
import type { Recording } from "./recording";

/** Hand the pictures of an image topic to a recording; returns a function that stops. */
export function recordCamera(connection: Connection, topic: string, recording: Recording): () => void {
  const stream = new PictureStream(connection, topic);
  const stop = stream.picture.subscribe((picture) => {
    if (picture === null) return;
    const { image, width, height, header } = picture;
    recording.add(image, { left: 0, top: 0, width, height }, header.stamp.sec + header.stamp.nsec / 1e9);
  });
  return () => {
    stop();
    stream.close();
  };
}
