/** Pictures of image topics, side by side or one enlarged (rqt_image_view). */

import { signal } from "@preact/signals";
import type { JSX } from "preact";
import { useRef } from "preact/hooks";

import type { Page } from "../page/page";
import { forEachNew } from "../page/session";
import { MenuButton } from "../theme/menu";
import type { MenuItem } from "../theme/menu_list";
import { ImageTile } from "./images/image_tile";
import type { Panel, PanelProps } from "./panel";
import { perPage } from "./per_page";
import { useShown } from "./use";

const TYPES = ["sensor_msgs/Image", "sensor_msgs/CompressedImage"];

class ImagesState {
  readonly topics = signal<readonly string[]>([]);
  readonly enlarged = signal<string | null>(null);

  constructor(private readonly page: Page) {
    forEachNew(
      () => page.session.images,
      (topic) => this.add(topic),
    );
  }

  /** Image topics that are not shown yet. */
  others(): readonly string[] {
    const all = [...this.page.connection.topics.value.values()];
    return all
      .filter(({ name, type }) => TYPES.includes(type) && !this.topics.value.includes(name))
      .map(({ name }) => name)
      .sort();
  }

  add(topic: string): void {
    this.topics.value = [...this.topics.peek(), topic];
    this.enlarged.value = null;
  }

  remove(topic: string): void {
    this.topics.value = this.topics.peek().filter((other) => other !== topic);
    this.enlarged.value = null;
  }
}

const imagesState = perPage((page) => new ImagesState(page));

function Images({ page }: PanelProps): JSX.Element {
  const state = imagesState(page);
  const root = useRef<HTMLDivElement>(null);
  const isShown = useShown(root);
  const enlarged = state.enlarged.value;
  const topics = enlarged === null ? state.topics.value : [enlarged];
  const others = state.others();
  return (
    <div class="stack" ref={root}>
      {topics.length === 0 && (
        <div class="empty">
          {others.length === 0 ? "Nothing publishes images." : "Choose a topic: "}
          {others.map((topic) => (
            <button key={topic} type="button" class="link offer" onClick={() => state.add(topic)}>
              {topic}
            </button>
          ))}
        </div>
      )}
      <div class="images">
        {isShown &&
          topics.map((topic) => (
            <ImageTile
              key={topic}
              connection={page.connection}
              topic={topic}
              isEnlarged={enlarged === topic}
              onEnlarge={() => void (state.enlarged.value = enlarged === topic ? null : topic)}
              onClose={() => state.remove(topic)}
            />
          ))}
      </div>
    </div>
  );
}

function Actions({ page }: PanelProps): JSX.Element {
  const state = imagesState(page);
  const items = (): readonly MenuItem[] =>
    state.others().map((topic) => ({ title: topic, run: () => state.add(topic) }));
  return (
    <MenuButton icon="plus" class="sml" items={items}>
      Picture
    </MenuButton>
  );
}

export const imagesPanel: Panel = {
  id: "images",
  title: "Images",
  programs: ["rqt_image_view", "image_view"],
  component: Images,
  actions: Actions,
};
