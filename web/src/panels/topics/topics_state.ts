/** State of the Topics panel: filter, selection, measured topics, publications. */

import { signal } from "@preact/signals";

import type { Connection, Subscription, TopicInfo, TopicStatistics } from "../../protocol/connection";
import type { StatusLevel } from "../../rviz/status_level";
import { perPage } from "../per_page";
import { Publication } from "./publication";

/** Types whose messages are too large to subscribe to only for their rate. */
const LARGE =
  /^(sensor_msgs\/(Image|CompressedImage|PointCloud2?)|stereo_msgs\/DisparityImage|nav_msgs\/OccupancyGrid|theora_image_transport\/Packet)$/;

export class TopicsState {
  readonly filter = signal("");
  readonly isFiltering = signal(false);
  readonly selected = signal<string | null>(null);
  readonly publications = signal<readonly Publication[]>([]);
  /** Large topics whose rate a person asked to measure. */
  readonly measuredAnyway = signal<ReadonlySet<string>>(new Set());
  private readonly meters = new Map<string, Subscription>();

  constructor(private readonly connection: Connection) {}

  /** Subscribe to the shown topics to measure their rates. */
  measure(topics: Iterable<TopicInfo>): void {
    for (const topic of topics) {
      if (this.meters.has(topic.name) || !this.isMeasured(topic)) continue;
      this.meters.set(
        topic.name,
        this.connection.subscribeRaw(topic.name, () => undefined),
      );
    }
  }

  isMeasured(topic: TopicInfo): boolean {
    return !LARGE.test(topic.type) || this.measuredAnyway.value.has(topic.name);
  }

  ask(topic: string): void {
    this.measuredAnyway.value = new Set(this.measuredAnyway.peek()).add(topic);
  }

  /** Stop measuring: the panel is closed. */
  rest(): void {
    for (const subscription of this.meters.values()) subscription.close();
    this.meters.clear();
  }

  /** The publication on a topic, made at its first use. */
  publication(topic: string, type: string): Publication {
    const known = this.publications.peek().find((one) => one.topic === topic && one.type === type);
    if (known !== undefined) return known;
    const publication = new Publication(this.connection, topic, type);
    this.publications.value = [...this.publications.peek(), publication];
    return publication;
  }
}

export const topicsState = perPage((page) => new TopicsState(page.connection));

/** Topics that are published, or only subscribed to. */
export function allTopics({ topics, graph }: Connection): ReadonlyMap<string, TopicInfo> {
  const waiting = [...graph.value.types].map(([name, type]): [string, TopicInfo] => [
    name,
    { name, type, encoding: "ros1" },
  ]);
  return new Map([...waiting, ...topics.value]);
}

/** Topics whose name or type contains a text, sorted by name. */
export function matchingTopics(topics: ReadonlyMap<string, TopicInfo>, text: string): readonly TopicInfo[] {
  const part = text.trim().toLowerCase();
  return [...topics.values()]
    .filter(({ name, type }) => name.toLowerCase().includes(part) || type.toLowerCase().includes(part))
    .sort((one, other) => (one.name < other.name ? -1 : 1));
}

/** Status of a topic: OK while messages come, a warning after they stopped, a ring before the first. */
export function topicLevel({ rate, lastAt }: TopicStatistics, now: number): StatusLevel {
  if (lastAt === null) return "none";
  const seconds = (now - lastAt) / 1000;
  return rate !== null && rate > 0 && seconds > Math.max(2, 3 / rate) ? "warn" : "ok";
}
