/** Topics that no display shows, with a class that can show each. */

import type { TopicInfo } from "../protocol/connection";
import type { Offer } from "./display_list";
import { displayClasses } from "./registry";

/** The class for a type of message: the one of the same name, else the first that shows it. */
function classForType(type: string): string | null {
  const able = displayClasses().filter((entry) => entry.types.includes(type));
  const [, short = ""] = type.split("/");
  const same = able.find((entry) => entry.className.split("/")[1] === short);
  return (same ?? able[0])?.className ?? null;
}

/** Offers for the topics that are not among those shown; sorted by name. */
export function findOffers(topics: Iterable<TopicInfo>, shown: ReadonlySet<string>): readonly Offer[] {
  const offers: Offer[] = [];
  for (const topic of topics) {
    if (shown.has(topic.name) || topic.name.startsWith("trundle/")) continue;
    const className = classForType(topic.type);
    if (className !== null) offers.push({ topic, className });
  }
  return offers.sort((a, b) => a.topic.name.localeCompare(b.topic.name));
}
