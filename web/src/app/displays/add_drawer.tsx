/** Drawer of displays to add: for topics that no display shows, or of any class. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";

import { Button } from "../../theme/button";
import { Tabs } from "../../theme/tabs";
import type { Shell } from "../shell";

const TABS = [
  { id: "topic", title: "Topics not shown" },
  { id: "class", title: "By class" },
];

export function AddDrawer({ shell, onClose }: { readonly shell: Shell; readonly onClose: () => void }): JSX.Element {
  const { displays } = shell.page;
  const tab = useSignal("topic");
  const show = (className: string, topic?: string): void => {
    shell.display.value = topic === undefined ? displays.add(className) : displays.add(className, topic);
  };
  const offers = displays.offers.value;
  return (
    <section class="drawer" aria-label="Add a display">
      <div class="tabs">
        <Tabs label="Add a display" items={TABS} selected={tab.value} onSelect={(id) => (tab.value = id)} />
        <span class="sp" />
        <Button icon="close" label="Close this list" small onClick={onClose} />
      </div>
      <div class="scroll">
        {tab.value === "topic" && offers.length === 0 && <p class="empty">All topics with a display are shown.</p>}
        {tab.value === "topic"
          ? offers.map(({ topic, className }) => (
              <Entry
                key={topic.name}
                name={topic.name}
                detail={short(className)}
                action="Show"
                onClick={() => show(className, topic.name)}
              />
            ))
          : displays.classes.map((name) => (
              <Entry key={name} name={short(name)} detail="" action="Add" onClick={() => show(name)} />
            ))}
      </div>
    </section>
  );
}

function short(className: string): string {
  return className.replace(/^rviz\//, "");
}

interface EntryProps {
  readonly name: string;
  readonly detail: string;
  readonly action: string;
  readonly onClick: () => void;
}

function Entry({ name, detail, action, onClick }: EntryProps): JSX.Element {
  return (
    <div class="dr">
      <span class="n" data-tip={name.length > 24 ? name : undefined}>
        {name}
      </span>
      <span class="r">{detail}</span>
      <button type="button" class="b" aria-label={`${action} ${name}`} onClick={onClick}>
        {action}
      </button>
    </div>
  );
}
