/** The bar on top: the clock and its controls, recording, the connection. */

import type { JSX } from "preact";

import { Button } from "../theme/button";
import { clock, count } from "../theme/format";
import { Icon } from "../theme/icons";
import { MenuButton } from "../theme/menu";
import type { MenuItem } from "../theme/menu_list";
import { Clock } from "./clock";
import { ConnectionChip } from "./connection_chip";
import { canControl, LOOKS_ONLY } from "../page/looking";
import { colorOf, nameOf } from "../page/people";
import { simulates } from "./simulation_commands";
import type { Shell } from "./shell";
import { switchTheme } from "./theme";

export function Bar({ shell }: { readonly shell: Shell }): JSX.Element {
  const { page, layout } = shell;
  const phone = layout.isPhone.value;
  return (
    <header class="bar" aria-label="Trundle">
      <Mark />
      {!phone && <Title shell={shell} />}
      {!canControl(page) && <LookingOnly isShort={phone} />}
      {simulates(page) ? canControl(page) && <SimulationControls shell={shell} /> : <Freeze shell={shell} />}
      {!phone && <span class="sep" />}
      <Clock shell={shell} />
      <span class="sp" />
      {!phone && <Record shell={shell} />}
      {!phone && <Button icon="timeline" label="Timeline" onClick={() => shell.dock.open("timeline")} />}
      {!phone && <span class="sep" />}
      <PeopleHere shell={shell} />
      <ConnectionChip shell={shell} />
      {phone ? <More shell={shell} /> : <Corner shell={shell} />}
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
      <h1>{name}</h1>
      {of !== null && of !== name && <span class="of wide">· {of}</span>}
      <span class="sep" />
    </>
  );
}

function SimulationControls({ shell }: { readonly shell: Shell }): JSX.Element {
  const { commands, layout, page } = shell;
  const paused = page.world.state.value?.paused ?? true;
  const name = paused ? "Play" : "Pause";
  const isTight = layout.isPhone.value && page.people.value.people.length > 1; // who is there takes its place
  const run = (id: string): void =>
    commands.all
      .peek()
      .find((command) => command.id === id)
      ?.run();
  const resets = commands.all.value.filter((command) => command.id.startsWith("reset.") || command.id === "reload");
  const isRecorded = page.session.kind !== "simulation";
  return (
    <>
      <button
        type="button"
        class={isTight ? "b pri ic" : "b pri"}
        aria-label={name}
        data-tip={`${name} (Space)`}
        onClick={() => run("play_pause")}
      >
        <PlayShape paused={paused} />
        {!isTight && name}
      </button>
      {!layout.isPhone.value && !isRecorded && (
        <>
          <Button icon="step" label="Step 1" keys="." onClick={() => run("step")}>
            Step 1
          </Button>
          <MenuButton
            icon="reset"
            items={() => resets.map(({ title, keys, run: act }): MenuItem => ({ title, keys, run: act }))}
          >
            Reset
          </MenuButton>
        </>
      )}
    </>
  );
}

function LookingOnly({ isShort }: { readonly isShort: boolean }): JSX.Element {
  return (
    <span class="looking" data-tip={`${LOOKS_ONLY} Others control time, robots, topics and the world.`} tabIndex={0}>
      <Icon name="eye" />
      {isShort ? "Look" : "Looking only"}
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
      ...(person.view_only ? { detail: "looks only" } : {}),
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
  const state = shell.page.world.state.value;
  if (state?.recording === undefined || !canControl(shell.page)) return null;
  const since = state.recording?.since_ns;
  const running = since !== undefined;
  const text = running ? `Recording ${clock((state.time_ns - since) / 1e9, 0)}` : "Record";
  const toggle = (): void => shell.request("Record", "record", { on: !running });
  return (
    <button type="button" class={running ? "b rec run" : "b rec"} aria-pressed={running} onClick={toggle}>
      <span class="dot" />
      {text}
    </button>
  );
}

function Corner({ shell }: { readonly shell: Shell }): JSX.Element {
  const { theme } = shell.page;
  const dark = theme.value === "dark";
  return (
    <>
      <Button
        icon={dark ? "sun" : "moon"}
        label={dark ? "Light theme" : "Dark theme"}
        onClick={() => switchTheme(theme)}
      />
      <Button icon="find" label="Search commands, Ctrl K" onClick={() => (shell.dialog.value = "palette")}>
        <kbd>Ctrl K</kbd>
      </Button>
      <Button label="Help" keys="?" class="ic strong" onClick={() => (shell.dialog.value = "help")}>
        ?
      </Button>
    </>
  );
}

/** Phone menu with the controls that do not fit into the bar. */
function More({ shell }: { readonly shell: Shell }): JSX.Element {
  const { commands, page } = shell;
  const items = (): readonly MenuItem[] => {
    const shown = commands.all
      .peek()
      .filter(({ id, group }) => group === "Simulation" && id !== "play_pause" && canControl(page));
    return [
      ...shown.map(({ title, run, enabled }) => ({ title, run, disabled: !(enabled?.() ?? true) })),
      { title: page.theme.peek() === "dark" ? "Light theme" : "Dark theme", run: () => switchTheme(page.theme) },
      { title: "Search commands", run: () => (shell.dialog.value = "palette") },
    ];
  };
  return <MenuButton icon="dots" label="More" items={items} />;
}
