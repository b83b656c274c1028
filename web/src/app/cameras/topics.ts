/** Cameras with a tile: cameras of the world, image topics that the launch shows, and displays of pictures. */

import type { Manifest, PageSession } from "../../protocol/generated/page_messages";
import type { Display } from "../../displays/display";
import { isEnabled, withMembers } from "../../displays/group";
import { PictureDisplay } from "../../displays/pictures/picture_display";
import type { TopicInfo } from "../../protocol/connection";

export interface CameraTopic {
  readonly name: string;
  readonly topic: string;
  /** Update rate of a simulated camera [Hz]; null: not simulated. */
  readonly rate: number | null;
  /** Display that draws the scene over the topic's picture; absent: the tile shows the topic's picture as it is. */
  readonly display?: PictureDisplay;
}

export function cameraTopics(
  session: Pick<PageSession, "images">,
  manifest: Manifest | null,
  displays: readonly Display[] = [],
): readonly CameraTopic[] {
  const enabled = withMembers(displays, isEnabled).filter((display) => display instanceof PictureDisplay);
  const shown = enabled.flatMap((display): CameraTopic[] => {
    const { topic } = display;
    return topic === null ? [] : [{ name: display.name.value, topic, rate: null, display }];
  });
  const taken = new Set(shown.filter(({ display }) => display?.className === "rviz/Image").map(({ topic }) => topic));
  const cameras = (manifest?.cameras ?? []).map(({ name, topic, rate }) => ({ name, topic, rate }));
  const known = new Set([...taken, ...cameras.map((camera) => camera.topic)]);
  const requested = session.images
    .filter((topic) => !known.has(topic))
    .map((topic) => ({ name: topic.replace(/^\//, ""), topic, rate: null }));
  return [...requested, ...cameras.filter(({ topic }) => !taken.has(topic)), ...shown];
}

/** Unique key of a tile: a topic may have one tile of its own and one with the scene drawn over it. */
export function tileKey({ topic, display }: CameraTopic): string {
  return display === undefined ? topic : `${display.className} ${display.name.value} ${topic}`;
}

/** Compressed topic, if there is one and the page is loaded over a network, which raw pictures would overload. */
export function streamedTopic(topic: string, topics: ReadonlyMap<string, TopicInfo>, host: string): string {
  const compressed = `${topic}/compressed`;
  const isNear = /^(localhost|127\.|\[::1\])/.test(host);
  return !isNear && topics.has(compressed) ? compressed : topic;
}
