/** Drawer of parts to add to the edited model: links, joints, sensors, plugins. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect } from "preact/hooks";

import type { AddPart, DraftInfo, DraftOffers } from "../../protocol/generated/page_messages";
import type { Shell } from "../shell";
import { Button } from "../../theme/button";
import { Icon } from "../../theme/icons";
import { Tabs } from "../../theme/tabs";
import { findPart, linkAround } from "../../scene/draft";

const TABS = [
  { id: "link", title: "Link" },
  { id: "joint", title: "Joint" },
  { id: "sensor", title: "Sensor" },
  { id: "plugin", title: "Plugin" },
];
const SHAPES = ["box", "sphere", "cylinder", "capsule", "ellipsoid"];
const SHAPE_PARTS = ["visual", "collision"] as const;

interface DrawerProps {
  readonly shell: Shell;
  readonly draft: DraftInfo;
  readonly onClose: () => void;
}

interface Offer {
  readonly kind: AddPart["kind"];
  readonly type: string;
  readonly name: string;
  readonly detail: string;
}

export function PartDrawer({ shell, draft, onClose }: DrawerProps): JSX.Element {
  const tab = useSignal("link");
  const search = useSignal("");
  const offers = useSignal<DraftOffers | null>(null);
  useEffect(() => {
    void shell.editor.ask("Add", "draft_offers", {}).then((answer) => (offers.value = answer));
  }, [shell]);
  const query = search.value.trim().toLowerCase();
  const matches = offersOf(tab.value, offers.value).filter(({ name, detail }) =>
    `${name} ${detail}`.toLowerCase().includes(query),
  );
  return (
    <section class="drawer" aria-label="Add to the model">
      <div class="tabs">
        <Tabs label="Add to the model" items={TABS} selected={tab.value} onSelect={(id) => (tab.value = id)} />
        <span class="sp" />
        <Button icon="close" label="Close this list" small onClick={onClose} />
      </div>
      <Target shell={shell} draft={draft} tab={tab.value} />
      {matches.length + query.length > 20 && (
        <label class="field find small">
          <Icon name="find" />
          <input
            type="search"
            placeholder="Search"
            aria-label="Search parts"
            onInput={(event) => (search.value = event.currentTarget.value)}
          />
        </label>
      )}
      <div class="scroll">
        {matches.map(({ kind, type, name, detail }) => (
          <div class="dr" key={`${kind} ${type}`}>
            <span class="n" data-tip={detail === "" ? name : `${name}: ${detail}`}>
              {name}
            </span>
            <span class="r" />
            <button
              type="button"
              class="b"
              aria-label={`Add ${name}`}
              onClick={() => void shell.editor.add(kind, type)}
            >
              Add
            </button>
          </div>
        ))}
      </div>
    </section>
  );
}

function offersOf(tab: string, offers: DraftOffers | null): readonly Offer[] {
  const of = (kind: Offer["kind"], types: readonly string[]): Offer[] =>
    types.map((type) => ({ kind, type, name: type, detail: "" }));
  switch (tab) {
    case "link": {
      const onLink = SHAPE_PARTS.flatMap((kind) =>
        SHAPES.map((type) => ({ kind, type, name: `${kind}: ${type}`, detail: "on the selected link" })),
      );
      const meshes = (offers?.meshes ?? []).map((type) => ({
        kind: "link" as const,
        type,
        name: type.split("/").at(-1) ?? type,
        detail: type,
      }));
      return [...of("link", SHAPES), ...onLink, ...meshes];
    }
    case "joint":
      return of("joint", offers?.joints ?? []);
    case "sensor":
      return of("sensor", offers?.sensors ?? []);
    default:
      return (offers?.plugins ?? []).map(({ filename, about }) => ({
        kind: "plugin",
        type: filename,
        name: filename,
        detail: about,
      }));
  }
}

/** Line that names the parent of the next part. */
function Target({
  shell,
  draft,
  tab,
}: {
  readonly shell: Shell;
  readonly draft: DraftInfo;
  readonly tab: string;
}): JSX.Element | null {
  const selection = shell.page.selection.value;
  const path = selection?.kind === "part" ? selection.part : [];
  const link = linkAround(path);
  const links = draft.parts.filter((part) => part.tag === "link");
  const sensor = findPart(draft, path)?.tag === "sensor" ? path.at(-1) : undefined;
  const hint = {
    joint:
      links.length < 2
        ? "A joint joins two links: add them first."
        : `Its child is ${link?.at(-1) ?? "the last link"}; parent and child can be changed.`,
    sensor:
      links.length === 0
        ? "A sensor sits on a link: add one first."
        : `On ${link?.at(-1) ?? links[0]?.name ?? ""}, with the plugin that publishes it.`,
    plugin:
      sensor === undefined
        ? "On the model; plugins of sensors on the sensor that is selected."
        : `On ${sensor}, if it is a sensor's.`,
  }[tab];
  return hint === undefined ? null : <p class="sm t2 target">{hint}</p>;
}
