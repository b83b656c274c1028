/** Menu of the parts shown of all models and of the world, of its panes, and of a video of the view. */

import type { JSX } from "preact";

import { WORLD_PARTS } from "../../scene/overlays/shown_parts";
import { Button } from "../../theme/button";
import { MenuButton } from "../../theme/menu";
import type { MenuItem } from "../../theme/menu_list";
import type { Command, Page } from "../../page/page";
import { isWorldPartShown, PART_NAMES, partsOf, WORLD_PART_NAMES } from "./shown_parts";
import { SplitMenu } from "../panes/split_menu";
import type { Shell } from "../shell";

export function ViewMenu({ shell }: { readonly shell: Shell }): JSX.Element {
  const { page, videos } = shell;
  const isRecorded = videos.has("");
  return (
    <div class="tools float" role="group" aria-label="View">
      {page.world.manifest.value !== null && (
        <MenuButton icon="eye" label="Show in the view" items={() => shownItems(page)} />
      )}
      <SplitMenu shell={shell} />
      <Button
        icon="camera"
        label={isRecorded ? "Stop and save the video" : "Record a video of the view"}
        on={isRecorded}
        onClick={() => videos.toggleView()}
      />
    </div>
  );
}

export function shownItems(page: Page): readonly MenuItem[] {
  const { shown } = page.world;
  const parts = partsOf(page).map((part): MenuItem => {
    const isShown = shown.all.value.has(part);
    return { title: PART_NAMES[part], checked: isShown, stays: true, run: () => shown.setAll(part, !isShown) };
  });
  const world = WORLD_PARTS.map((part): MenuItem => {
    const isShown = isWorldPartShown(page, part);
    const starts = part === WORLD_PARTS[0];
    const run = (): void => shown.setWorld(part, !isShown);
    return { title: WORLD_PART_NAMES[part], checked: isShown, stays: true, starts, run };
  });
  return [...parts, ...world];
}

/** Section of the parts shown of one model. */
export function ShownSection({ shell, model }: { readonly shell: Shell; readonly model: string }): JSX.Element {
  const { shown } = shell.page.world;
  return (
    <section class="sec">
      <h3>Show</h3>
      <div class="sides two">
        {partsOf(shell.page).map((part) => {
          const isShown = shown.of(part, model);
          return (
            <Button key={part} small tone="line" on={isShown} onClick={() => shown.set(part, model, !isShown)}>
              {PART_NAMES[part]}
            </Button>
          );
        })}
      </div>
    </section>
  );
}

export function viewMenuCommands({ page }: Shell): readonly Command[] {
  const { world } = page;
  const command = (id: string, title: string, run: () => void): Command => ({
    id,
    title,
    group: "View",
    enabled: () => world.manifest.peek() !== null,
    run,
  });
  return [
    ...partsOf(page).map((part) =>
      command(part, `Show or hide ${PART_NAMES[part].toLowerCase()}`, () =>
        world.shown.setAll(part, !world.shown.all.peek().has(part)),
      ),
    ),
    ...WORLD_PARTS.map((part) =>
      command(`world.${part}`, `Show or hide ${WORLD_PART_NAMES[part].toLowerCase()}`, () =>
        world.shown.setWorld(part, !isWorldPartShown(page, part)),
      ),
    ),
  ];
}
