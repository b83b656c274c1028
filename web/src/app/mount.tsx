/** Draw a page into an element. */

import { effect, signal, untracked, type Signal } from "@preact/signals";
import { render } from "preact";

import "../theme/tokens.css";
import "../theme/base.css";
import "../theme/controls.css";
import "../theme/layout.css";
import "../theme/tree.css";
import "../theme/displays.css";
import "../theme/inspector.css";
import "../theme/editor.css";
import "../theme/scene.css";
import "../theme/dialogs.css";
import "../theme/insert.css";
import "../theme/lessons.css";
import "../theme/phone.css";
import "../theme/dockview.css";
import { editorCommands } from "./editor/editor_commands";
import type { Panel } from "../panels/panel";
import { App } from "./app";
import { modelCommands } from "./world/model_edits";
import { cameraCommands } from "./views/first_person";
import { insertionCommands } from "./insert/insertion_commands";
import { compareCommands } from "./compare_recording";
import { listenForKeys, type CommandList } from "./commands";
import { acceptDroppedFiles } from "./dialogs/open_files";
import type { Page } from "../page/page";
import { pageCommands, panelCommands, viewCommands } from "./page_commands";
import { splitCommands } from "./panes/split_menu";
import { Shell } from "./shell";
import { saveCommands } from "./dialogs/save_world";
import { simulationCommands } from "./simulation_commands";
import { toolCommands } from "./tool_bar";
import { rememberShown } from "./views/shown_parts";
import { viewMenuCommands } from "./views/view_menu";

export interface Parts {
  readonly page: Page;
  /** Panels of the dock, once they are loaded. */
  readonly panels: Promise<readonly Panel[]>;
  readonly commands: CommandList;
  /** Element that holds the scene's canvas. */
  readonly sceneHost: HTMLElement;
  /** True while the displays' messages are held back. */
  readonly frozen?: Signal<boolean>;
}

export function mount(root: HTMLElement, { page, panels, commands, sceneHost, frozen = signal(false) }: Parts): Shell {
  const shell = new Shell(page, commands, sceneHost, frozen);
  shell.layout.listen();
  const ofView = shell.isDrawn.peek()
    ? [...viewCommands(shell), ...toolCommands(shell), ...viewMenuCommands(shell), ...splitCommands(shell)]
    : [];
  commands.add(
    ...insertionCommands(shell),
    ...simulationCommands(shell),
    ...compareCommands(shell),
    ...saveCommands(shell),
    ...pageCommands(shell),
    ...ofView,
    ...modelCommands(shell),
    ...editorCommands(shell),
  );
  rememberShown(page);
  let removeCameras = (): void => undefined;
  effect(() => {
    const cameras = shell.isDrawn.peek() ? cameraCommands(page) : [];
    untracked(() => {
      removeCameras();
      removeCameras = commands.add(...cameras);
    });
  });
  shell.dock.load(panels).then(
    () => commands.add(...panelCommands(shell)),
    (error: unknown) => shell.notices.report("Panels", error instanceof Error ? error.message : String(error)),
  );
  listenForKeys(commands);
  acceptDroppedFiles(shell);
  effect(() => {
    document.title = shell.robot.value ?? page.session.title;
  });
  render(<App shell={shell} />, root);
  shell.lessons.start();
  return shell;
}
