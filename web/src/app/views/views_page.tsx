/** The Views page: rviz's view with its properties, and saved views. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";

import type { ViewController } from "../../scene/view_controller";
import { Button } from "../../theme/button";
import { Select } from "../../theme/select";
import { Tree } from "../../theme/tree";
import { lookThrough, toggleFirstPerson } from "./first_person";
import { isFollowing, toggleFollowing } from "./following";
import { frameSelection } from "./framing";
import type { Page } from "../../page/page";
import { propertyRows } from "../displays/property_rows";
import type { Shell } from "../shell";

const short = (className: string): string => className.replace(/^\w+\//, "");
const SIDES = ["front", "back", "left", "right", "top", "bottom"] as const;

export function ViewsPage({ shell }: { readonly shell: Shell }): JSX.Element {
  const { page } = shell;
  const { views } = page;
  const current = views.current.value;
  const toggled = useSignal<ReadonlyMap<string, boolean>>(new Map());
  const onToggle = (key: string, open: boolean): void => {
    toggled.value = new Map(toggled.value).set(key, open);
  };
  const isOpen = (key: string): boolean => toggled.value.get(key) ?? false;
  const use = (name: string): void => views.use(views.classes.find((className) => short(className) === name) ?? name);
  return (
    <div class="scroll">
      <div class="kind">
        <span class="t2">Type</span>
        <Select label="Type of view" value={short(current.className)} choices={typesOf(views)} onChange={use} />
        <Button small onClick={() => frameSelection(page, page.selection.peek())}>
          Frame
        </Button>
        <Button small on={isFollowing(page)} onClick={() => toggleFollowing(page)}>
          Follow
        </Button>
      </div>
      <Tree
        label="Current view"
        rows={propertyRows(current.properties, current.className, 0, { page, isOpen, onToggle })}
        onToggle={onToggle}
        onSelect={() => undefined}
      />
      <section class="sec">
        <h2>Look from</h2>
        <div class="sides">
          {SIDES.map((side) => (
            <Button key={side} small tone="line" onClick={() => views.lookFrom(side)}>
              {side.slice(0, 1).toUpperCase() + side.slice(1)}
            </Button>
          ))}
        </div>
      </section>
      <section class="sec">
        <h2>Camera</h2>
        <div class="sides">
          <Button small tone="line" onClick={() => views.toggleProjection()}>
            {isOrthographic(current) ? "Perspective" : "Orthographic"}
          </Button>
          <Button
            small
            tone="line"
            on={current.className === "rviz/FrameAligned" && isFollowing(page)}
            onClick={() => toggleFirstPerson(page)}
          >
            First person
          </Button>
          {page.world.manifest.value?.cameras.map((camera) => (
            <Button key={camera.topic} small tone="line" icon="camera" onClick={() => lookThrough(page, camera)}>
              {camera.name}
            </Button>
          ))}
        </div>
      </section>
      <section class="sec">
        <h2>
          Saved views
          <span class="sp" />
          <Button icon="plus" small onClick={() => saveView(shell)}>
            Save current view
          </Button>
        </h2>
        {views.saved.value.length === 0 && <p class="t2 sm">None yet.</p>}
        {views.saved.value.map((view) => (
          <div key={view.name.value} class="dr">
            <span class="n">{view.name.value}</span>
            <span class="r">{short(view.className)}</span>
            <button type="button" class="b" aria-label={`Use ${view.name.value}`} onClick={() => views.useSaved(view)}>
              Use
            </button>
            <Button icon="close" label={`Remove ${view.name.value}`} small onClick={() => removeView(shell, view)} />
          </div>
        ))}
      </section>
    </div>
  );
}

/** A simulated camera is a view that has no type of its own to choose. */
function typesOf({ classes, current }: Page["views"]): readonly string[] {
  const currentClass = current.value.className;
  return [...classes, ...(classes.includes(currentClass) ? [] : [currentClass])].map(short);
}

function isOrthographic({ properties }: ViewController): boolean {
  return properties.some(({ name, value }) => name === "Projection" && value.value === "Orthographic");
}

function saveView({ page }: Shell): void {
  const { views, displays } = page;
  const before = views.saved.peek();
  const view = views.copyCurrent(freeName(page));
  displays.edit(
    `Save ${view.name.peek()}`,
    () => (views.saved.value = [...before, view]),
    () => (views.saved.value = before),
  );
}

function removeView({ page }: Shell, view: ViewController): void {
  const { views, displays } = page;
  const before = views.saved.peek();
  displays.edit(
    `Remove ${view.name.peek()}`,
    () => (views.saved.value = before.filter((other) => other !== view)),
    () => (views.saved.value = before),
  );
}

function freeName({ views }: Page): string {
  const taken = new Set(views.saved.peek().map((view) => view.name.peek()));
  const base = short(views.current.peek().className);
  let number = 1;
  while (taken.has(`${base} ${number}`)) number += 1;
  return `${base} ${number}`;
}
