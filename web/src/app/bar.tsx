/** The bar on top: the clock and its controls, recording, the connection. */

import type { JSX } from "preact";
import { useRef } from "preact/hooks";

import { Button } from "../theme/button";
import { FittingPart, More, useFittingRow, type HiddenItem } from "../theme/fitting_row";
import { clock, count } from "../theme/format";
import { Icon } from "../theme/icons";
import { MenuButton } from "../theme/menu";
import type { MenuItem } from "../theme/menu_list";
import { Name } from "../theme/name";
import { Clock, speedItems } from "./clock";
import { ConnectionChip } from "./connection_chip";
import { canControl, VIEW_ONLY } from "../page/view_only";
import { colorOf, nameOf } from "../page/people";
import { simulates } from "./simulation_commands";
import type { Shell } from "./shell";
import { switchTheme } from "./theme";
import { shownItems } from "./views/view_menu";

export function Bar({ shell }: { readonly shell: Shell }): JSX.Element {
  return shell.layout.isPhone.value ? <PhoneBar shell={shell} /> : <WideBar shell={shell} />;
}

function PhoneBar({ shell }: { readonly shell: Shell }): JSX.Element {
  const { page } = shell;
  const row = useRef<HTMLElement>(null);
  useFittingRow(row);
  return (
    <header ref={row} class="bar" aria-label="Trundle">
      <FittingPart rank={1}>
        <Mark />
      </FittingPart>
      {!canControl(page) && <ViewOnly />}
      {simulates(page) ? canControl(page) && <PlayPause shell={shell} /> : <Freeze shell={shell} />}
      <Clock shell={shell} />
      <span class="sp" />
      <PeopleHere shell={shell} />
      <ConnectionChip shell={shell} />
      <MenuButton icon="dots" label="More" items={() => phoneItems(shell)} />
    </header>
  );
}

/** The bar of a wide page; a narrow window drops its words, and then moves its rarer controls into a menu. */
function WideBar({ shell }: { readonly shell: Shell }): JSX.Element {
  const { page } = shell;
  const row = useRef<HTMLElement>(null);
  useFittingRow(row);
  return (
    <header ref={row} class="bar" aria-label="Trundle">
      <Mark />
      <Title shell={shell} />
      {!canControl(page) && <ViewOnly />}
      {simulates(page) ? canControl(page) && <SimulationControls shell={shell} /> : <Freeze shell={shell} />}
      <span class="sep" />
      <Clock shell={shell} />
      <span class="sp" />
      <FittingPart rank={11} part="record">
        <Record shell={shell} />
      </FittingPart>
      <FittingPart rank={4} part="timeline">
        <Button icon="timeline" label="Timeline" onClick={() => shell.dock.open("timeline")} />
      </FittingPart>
      <span class="sep" />
      <PeopleHere shell={shell} />
      <ConnectionChip shell={shell} />
      <Corner shell={shell} />
      <More row={row} label="More" items={() => hiddenItems(shell)} />
    </header>
  );
}

function Mark(): JSX.Element {
  return (
    <svg
      class="mark"
      viewBox="0 0 22 22"
      fill="none"
      stroke="currentColor"
      stroke-width="2"
      role="img"
      aria-label="Trundle"
    >
      <circle cx="11" cy="11" r="8.5" />
      <circle cx="11" cy="11" r="2.2" fill="currentColor" stroke="none" />
      <path d="M11 2.500v4.500M18.400 15.200l-3.900-2.200M3.600 15.200l3.900-2.200" />
    </svg>
  );
}

const KINDS = { graph: "ROS graph", bag: "bag", log: "recorded run" } as const;

function Title({ shell }: { readonly shell: Shell }): JSX.Element {
  const { title, kind } = shell.page.session;
  const robot = shell.robot.value;
  const of = kind === "simulation" ? robot : KINDS[kind];
  const name = kind === "graph" ? (robot ?? title) : title;
  return (
    <>
      <h1 data-tip={name} style={{ minWidth: `min(20ch, ${name.length}ch)` }}>
        <Name text={name} />
      </h1>
      {of !== null && of !== name && (
        <FittingPart rank={1}>
          <span class="of">· {of}</span>
        </FittingPart>
      )}
      <span class="sep" />
    </>
  );
}

function SimulationControls({ shell }: { readonly shell: Shell }): JSX.Element {
  const isRecorded = shell.page.session.kind !== "simulation";
  return (
    <>
      <PlayPause shell={shell} />
      {!isRecorded && (
        <>
          <FittingPart rank={7} part="step">
            <Button icon="step" label="Step 1" keys="." onClick={() => runCommand(shell, "step")}>
              Step 1
            </Button>
          </FittingPart>
          <FittingPart rank={9} part="reset">
            <MenuButton icon="reset" items={() => resetItems(shell)}>
              Reset
            </MenuButton>
          </FittingPart>
        </>
      )}
    </>
  );
}

function PlayPause({ shell }: { readonly shell: Shell }): JSX.Element {
  const { layout, page } = shell;
  const paused = page.world.state.value?.paused ?? true;
  const name = paused ? "Play" : "Pause";
  const isTight = layout.isPhone.value && page.people.value.people.length > 1; // the list of people takes the label's place
  return (
    <button
      type="button"
      class={isTight ? "b pri ic" : "b pri"}
      aria-label={name}
      data-tip={`${name} (Space)`}
      onClick={() => runCommand(shell, "play_pause")}
    >
      <PlayShape paused={paused} />
      {!isTight && <FittingPart rank={20}>{name}</FittingPart>}
    </button>
  );
}

function runCommand({ commands }: Shell, id: string): void {
  commands.all
    .peek()
    .find((command) => command.id === id)
    ?.run();
}

function resetItems({ commands }: Shell): readonly MenuItem[] {
  const resets = commands.all.peek().filter(({ id }) => id.startsWith("reset.") || id === "reload");
  return resets.map(({ title, keys, run }) => ({ title, keys, run }));
}

function ViewOnly(): JSX.Element {
  return (
    <span class="looking" data-tip={`${VIEW_ONLY} Others control time, robots, topics and the world.`} tabIndex={0}>
      <Icon name="eye" />
      View only
    </span>
  );
}

/** Number of people at the page, if there are several; the menu lists them. */
function PeopleHere({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const { you, people } = shell.page.people.value;
  if (people.length < 2) return null;
  const label = count(people.length, "person", "people");
  const items = (): readonly MenuItem[] =>
    people.map((person) => ({
      title: person.number === you ? `${nameOf(person)}, you` : nameOf(person),
      ...(person.view_only ? { detail: "view only" } : {}),
      color: colorOf(person),
      disabled: person.selection === null || person.number === you,
      run: () => (shell.page.selection.value = person.selection),
    }));
  return (
    <MenuButton class="people" label={label} icon="people" items={items}>
      {shell.layout.isPhone.value ? people.length : label}
    </MenuButton>
  );
}

function PlayShape({ paused }: { readonly paused: boolean }): JSX.Element {
  return (
    <svg class="i" viewBox="0 0 16 16" aria-hidden="true">
      <path class="f" d={paused ? "M4.500 3v10l8.500-5z" : "M4 3h3v10H4zM9 3h3v10H9z"} />
    </svg>
  );
}

function Freeze({ shell }: { readonly shell: Shell }): JSX.Element {
  const frozen = shell.frozen.value;
  const toggle = (): void => {
    shell.frozen.value = !frozen;
  };
  return (
    <Button icon={frozen ? "play" : "pause"} tone="line" on={frozen} onClick={toggle}>
      Freeze view
    </Button>
  );
}

function Record({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const recording = recordingOf(shell);
  if (recording === null) return null;
  return (
    <button
      type="button"
      class={recording.isRunning ? "b rec run" : "b rec"}
      aria-pressed={recording.isRunning}
      onClick={recording.toggle}
    >
      <span class="dot" />
      {recording.text}
    </button>
  );
}

/** The recording that a person can start and stop; null: this page records nothing. */
function recordingOf(shell: Shell): { text: string; isRunning: boolean; toggle: () => void } | null {
  const state = shell.page.world.state.value;
  if (state?.recording === undefined || !canControl(shell.page)) return null;
  const since = state.recording?.since_ns;
  const isRunning = since !== undefined;
  const text = isRunning ? `Recording ${clock((state.time_ns - since) / 1e9, 0)}` : "Record";
  return { text, isRunning, toggle: () => shell.request("Record", "record", { on: !isRunning }) };
}

function Corner({ shell }: { readonly shell: Shell }): JSX.Element {
  const theme = themeItem(shell);
  const { lessons } = shell;
  return (
    <>
      <FittingPart rank={5} part="lessons">
        <Button icon="lesson" label="Lessons" on={lessons.isShown.value} onClick={() => lessons.toggle()} />
      </FittingPart>
      <FittingPart rank={5} part="share">
        <Button icon="share" label="Share" onClick={() => (shell.dialog.value = "share")} />
      </FittingPart>
      <FittingPart rank={6} part="theme">
        <Button icon={shell.page.theme.value === "dark" ? "sun" : "moon"} label={theme.title} onClick={theme.run} />
      </FittingPart>
      <FittingPart rank={8} part="find">
        <Button icon="find" label="Search commands, Ctrl K" onClick={() => (shell.dialog.value = "palette")}>
          <FittingPart rank={3}>
            <kbd>Ctrl K</kbd>
          </FittingPart>
        </Button>
      </FittingPart>
      <FittingPart rank={6} part="help">
        <Button label="Help" keys="?" class="ic strong" onClick={() => (shell.dialog.value = "help")}>
          ?
        </Button>
      </FittingPart>
    </>
  );
}

function themeItem({ page: { theme } }: Shell): { readonly title: string; readonly run: () => void } {
  return { title: theme.value === "dark" ? "Light theme" : "Dark theme", run: () => switchTheme(theme) };
}

/** Menu items for the controls of the wide bar that have no room. */
function hiddenItems(shell: Shell): readonly HiddenItem[] {
  const { dialog, page } = shell;
  const recording = recordingOf(shell);
  const speed = page.world.state.peek()?.speed ?? null;
  return [
    { part: "step", title: "Step 1", keys: ".", run: () => runCommand(shell, "step") },
    { part: "reset", title: "Reset", items: () => resetItems(shell) },
    { part: "speed", title: "Speed", items: () => speedItems(shell, speed) },
    ...(recording === null ? [] : [{ part: "record", title: recording.text, run: recording.toggle }]),
    { part: "timeline", title: "Timeline", run: () => shell.dock.open("timeline") },
    { part: "lessons", title: "Lessons", run: () => shell.lessons.toggle() },
    { part: "share", title: "Share", run: () => (dialog.value = "share") },
    { part: "theme", ...themeItem(shell) },
    { part: "find", title: "Search commands", keys: "Ctrl K", run: () => (dialog.value = "palette") },
    { part: "help", title: "Help", keys: "?", run: () => (dialog.value = "help") },
  ];
}

/** Phone menu with the controls that do not fit into the bar: time, files, the view, the page. */
function phoneItems(shell: Shell): readonly MenuItem[] {
  const { page, dialog } = shell;
  const recording = recordingOf(shell);
  const groups: readonly (readonly MenuItem[])[] = [
    [
      ...commandItems(shell, ["step"]),
      ...submenu("Speed", simulates(page) ? speedItems(shell, page.world.state.peek()?.speed ?? null) : []),
      ...submenu("Reset", resetItems(shell)),
      ...commandItems(shell, ["time"]),
    ].filter(() => canControl(page)),
    [
      ...(recording === null ? [] : [{ title: recording.text, run: recording.toggle }]),
      ...submenu("Save", commandItems(shell, ["save_world", "replay", "replay.glb"])),
    ],
    [
      ...commandItems(shell, ["frame", "picture", "video"]),
      ...submenu(
        "Show in the view",
        shell.isDrawn.peek() && page.world.manifest.peek() !== null ? shownItems(page) : [],
      ),
    ],
    [
      { title: "Lessons", run: () => shell.lessons.toggle() },
      { title: "Share", run: () => (dialog.value = "share") },
      themeItem(shell),
      { title: "Search commands", run: () => (dialog.value = "palette") },
    ],
  ];
  return groups
    .filter((group) => group.length > 0)
    .flatMap((group, number) => group.map((item, index) => ({ ...item, starts: number > 0 && index === 0 })));
}

function commandItems({ commands }: Shell, ids: readonly string[]): readonly MenuItem[] {
  return ids
    .flatMap((id) => commands.all.peek().filter((command) => command.id === id))
    .map(({ title, run, enabled }) => ({ title, run, disabled: enabled?.() === false }));
}

function submenu(title: string, items: readonly MenuItem[]): readonly MenuItem[] {
  return items.length === 0 ? [] : [{ title, items: () => items }];
}
