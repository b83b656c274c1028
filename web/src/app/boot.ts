/** Start: make the parts of a page for its session, draw it. */

import "../displays/all";

import { effect, signal } from "@preact/signals";

import type { Manifest } from "../protocol/generated/page_messages";
import { DisplayStore } from "../displays/display_store";
import { feedTransforms } from "../frames/tf_topics";
import { TransformTree } from "../frames/transform_tree";
import { read } from "../protocol/check";
import { connect } from "../protocol/foxglove_connection";
import { pageSession } from "../protocol/generated/page_checks";
import { GraphNames } from "../protocol/graph_names";
import { SceneInput } from "../scene/pointer_input";
import { ThreeScene } from "../scene/three_scene";
import { ViewList } from "../scene/views/view_list";
import { BodyOverlays } from "../scene/overlays/body_overlays";
import { ContactMarks } from "../scene/overlays/contact_marks";
import { RangeLines } from "../scene/overlays/range_lines";
import { SelectionOutline } from "../scene/world/selection_outline";
import { WorldFeed } from "../scene/world/world_feed";
import { ToolList } from "../tools/tool_list";
import { AXIS_RGB } from "../shapes/axes";
import { followAxisColors } from "./axis_colors";
import { CommandList } from "./commands";
import { Drive } from "../page/drive";
import { GoalQueue } from "../page/goal_queue";
import { firstPicture } from "./first_picture";
import { markGoals } from "./goal_marks";
import { freezable } from "./freeze";
import { outlinedBodies, targetPose } from "./views/framing";
import { mount } from "./mount";
import { openSceneMenu, openSelectedMenu } from "./object_menu/object_menu";
import type { Page } from "../page/page";
import { followPeople } from "../page/people";
import { lessonOutlines } from "./lessons/marks";
import { labelOthers, othersOutlines } from "./people_marks";
import { liveSession } from "../page/session";
import { startDisplays } from "./start";
import { startView } from "./views/first_view";
import { makeTheme } from "./theme";
import { UndoHistory } from "./undo";
import type { Shell } from "./shell";
import { makeEditor } from "./world/edits";
import { allModels, type ScopedModel } from "../page/world_nodes";

/** Make the page's parts for a session, which comes as JSON, and draw them into an element. Throws a `MessageFault`. */
export function boot(root: HTMLElement, json: string): void {
  const first = read(json, "the session", pageSession);
  const address = cleanAddress(location.href, first.view_only);
  history.replaceState(history.state, "", address);
  const frozen = signal(false);
  const connection = connect(address);
  const session = liveSession(first, connection, () => location.reload());
  const view = freezable(connection, frozen); // freezing holds back displays, not panels
  const names = new GraphNames(first.namespace, first.remappings);
  const undo = new UndoHistory();
  const commands = new CommandList();
  const theme = makeTheme();
  const fixedFrame = signal(first.fixed_frame ?? "map");
  const selection: Page["selection"] = signal(null);
  const hovered: Page["hovered"] = signal(null);
  const goals = new GoalQueue();
  const axisColors = signal(AXIS_RGB);

  const sceneHost = document.createElement("div");
  const scene = new ThreeScene(sceneHost);
  const frames = new TransformTree();
  feedTransforms(frames, view, names);
  const world = new WorldFeed(connection, scene, frames, fixedFrame);
  const views: ViewList = new ViewList(scene, (target) => targetPose(page, target));
  const editor = first.kind !== "simulation" || first.view_only ? null : makeEditor(world, () => shell);
  const tools = new ToolList({
    connection,
    names,
    scene,
    views,
    fixedFrame,
    selection,
    select: (picked) => shell.select(picked),
    hovered,
    goals,
    editor,
    viewOnly: first.view_only,
  });
  const displays: DisplayStore = new DisplayStore({
    connection: view,
    names,
    frames,
    scene,
    undo,
    views,
    tools,
    axisColors,
    ghostShapes: world.ghostShapes,
  });
  const drive = new Drive({
    connection,
    get session() {
      return session.value;
    },
  });
  const people = followPeople(connection, selection);
  const page: Page = {
    get session() {
      return session.value;
    },
    connection,
    frames,
    scene,
    views,
    world,
    displays,
    tools,
    selection,
    hovered,
    commands,
    undo,
    drive,
    goals,
    theme,
    people,
  };

  effect(() => {
    fixedFrame.value = displays.fixedFrame.value;
  });
  followAxisColors(page, theme, axisColors);
  new SceneInput(
    scene,
    views,
    (input) => tools.pointer(input),
    (at) => (at === null ? openSelectedMenu(shell) : openSceneMenu(shell, at.x, at.y)),
  );
  effect(() => {
    scene.element.style.cursor = tools.current.value.cursor;
  });
  effect(() => {
    if (tools.current.value.className !== "rviz/SetGoal") goals.collects.value = false;
  });
  labelOthers(page);
  markGoals(page);
  const modelsOf = ({ models }: Manifest): readonly ScopedModel[] => allModels(models);
  new BodyOverlays(scene, world, modelsOf);
  new ContactMarks(scene, world, connection, modelsOf);
  new RangeLines(scene, world, connection);
  scene.onTick((elapsed) => displays.update(view.now(), elapsed));
  const shell: Shell = mount(root, {
    page,
    panels: firstPicture(page).then(async () => (await import("../panels")).panels),
    commands,
    sceneHost,
    frozen,
  });
  new SelectionOutline(scene, world, () => [
    ...othersOutlines(page),
    ...lessonOutlines(shell),
    { ...outlinedBodies(page), color: "--accent" },
  ]);
  startDisplays(shell);
  startView(shell);
}

/** Page address without its token, which a cookie holds from now on; a view-only page keeps its mark. */
function cleanAddress(address: string, viewOnly: boolean): string {
  const url = new URL(address);
  url.searchParams.delete("token");
  if (viewOnly) url.searchParams.set("view_only", "");
  return url.href.replace("view_only=", "view_only");
}
