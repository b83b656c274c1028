/** The Inspector: the selected object's values with units, and its source file and line. */

import type { JSX } from "preact";

import { PartForm } from "../editor/part_form";
import { NoTransform } from "../../frames/transform";
import { Button } from "../../theme/button";
import { Icon, type IconName } from "../../theme/icons";
import { Name } from "../../theme/name";
import { frameSelection } from "../views/framing";
import { JointSection, ModelJoints } from "./joint_sliders";
import { LinkSections, ModelSections } from "./link_sections";
import type { Selection } from "../../page/page";
import { PickedSection } from "./picked_section";
import { PluginSections, SensorSections } from "./part_sections";
import { PoseSection } from "./pose_section";
import type { Shell } from "../shell";
import { ShownSection } from "../views/view_menu";
import { sensorIcon } from "../../page/world_nodes";
import { KeyValue } from "./value_rows";
import { LightSections, WorldSections } from "./world_sections";
import { findJoint, findLink, findModel, findPlugin, findSensor } from "../../page/selection_lookup";

export function Inspector({ shell }: { readonly shell: Shell }): JSX.Element {
  const selection = shell.page.selection.value;
  const { draft } = shell.editor;
  if (selection?.kind === "part") {
    return draft.value === null ? (
      <p class="empty">It is no longer edited.</p>
    ) : (
      <PartForm shell={shell} draft={draft.value} path={selection.part} />
    );
  }
  if (selection === null) return <p class="empty">Nothing is selected. Click something in the 3D view or in a tree.</p>;
  return (
    <div class="scroll inspector">
      <Title shell={shell} selection={selection} />
      <Sections shell={shell} selection={selection} />
    </div>
  );
}

type Shown = Exclude<Selection, { readonly kind: "part" }>;

interface SelectionProps {
  readonly shell: Shell;
  readonly selection: Shown;
}

function Sections({ shell, selection }: SelectionProps): JSX.Element | null {
  const { page } = shell;
  const manifest = page.world.manifest.value;
  if (selection.kind === "picked") return <PickedSection fields={selection.fields} />;
  if (selection.kind === "frame") return <FrameSections shell={shell} frame={selection.frame} />;
  if (selection.kind === "world") return manifest === null ? null : <WorldSections shell={shell} manifest={manifest} />;
  if (selection.kind === "light") {
    const light = manifest?.lights.find(({ name }) => name === selection.light);
    return light === undefined ? <Removed /> : <LightSections shell={shell} light={light} />;
  }
  if (selection.kind === "plugin") {
    const plugin = findPlugin(page, selection.of, selection.plugin);
    return plugin === null ? <Removed /> : <PluginSections plugin={plugin} />;
  }
  if (selection.kind === "sensor") {
    const sensor = findSensor(page, selection.model, selection.link, selection.sensor);
    return sensor === null ? <Removed /> : <SensorSections shell={shell} selection={selection} sensor={sensor} />;
  }
  const model = manifest !== null ? findModel(page, selection.model) : null;
  if (model === null) return <Removed />;
  if (selection.kind === "joint") {
    const joint = findJoint(page, selection.model, selection.joint);
    return joint === null ? <Removed /> : <JointSection shell={shell} model={selection.model} joint={joint} />;
  }
  const link = selection.kind === "link" ? findLink(page, selection.model, selection.link) : null;
  if (selection.kind === "link" && link === null) return <Removed />;
  return (
    <>
      {link === null ? (
        <ModelSections shell={shell} name={selection.model} model={model} />
      ) : (
        <LinkSections shell={shell} model={selection.model} link={link} isStatic={model.static} />
      )}
      <ModelJoints shell={shell} name={selection.model} model={model} />
      {shell.isDrawn.value && <ShownSection shell={shell} model={selection.model} />}
    </>
  );
}

function Removed(): JSX.Element {
  return <p class="empty">It is no longer in the world.</p>;
}

function FrameSections({ shell, frame }: { readonly shell: Shell; readonly frame: string }): JSX.Element {
  const { frames, displays } = shell.page;
  const fixed = displays.fixedFrame.value;
  const pose = (): ReturnType<typeof frames.lookup> => frames.lookup(fixed, frame, 0n);
  const info = frames.describe().find((entry) => entry.name === frame);
  const transform = pose();
  return (
    <>
      {transform instanceof NoTransform ? (
        <p class="empty">
          {transform.text}. {transform.advice}
        </p>
      ) : (
        <PoseSection within={fixed} pose={() => asPose(pose())} />
      )}
      <section class="sec">
        <h3>Frame</h3>
        <KeyValue name="Parent" value={info?.parent ?? "none"} />
        <KeyValue name="Kind" value={info?.isStatic === true ? "static" : "moving"} />
      </section>
    </>
  );
}

function asPose<T>(transform: T | NoTransform): T | null {
  return transform instanceof NoTransform ? null : transform;
}

const ICONS: Readonly<Record<Exclude<Shown["kind"], "sensor">, IconName>> = {
  world: "world",
  light: "light",
  model: "model",
  link: "link",
  joint: "joint",
  plugin: "plugin",
  frame: "frame",
  picked: "select",
};

function Title({ shell, selection }: SelectionProps): JSX.Element {
  const {
    name,
    of,
    source,
    icon = selection.kind === "sensor" ? "sensor" : ICONS[selection.kind],
  } = titleOf(shell, selection);
  return (
    <div class="ti">
      <h2>
        <Icon name={icon} />
        <Name text={name} />
      </h2>
      {selection.kind !== "picked" && (
        <Button
          icon="focus"
          label="Frame in the view"
          keys="F"
          small
          onClick={() => frameSelection(shell.page, selection)}
        />
      )}
      <span class="sm t2">
        {of}
        {source !== null && !source.startsWith("<") && (
          <>
            {of === "" ? "" : " · "}
            <span class="src" data-tip={source}>
              {shortSource(source)}
            </span>
          </>
        )}
      </span>
    </div>
  );
}

/** The file with its folder, and the line; the whole path is in the tooltip. */
function shortSource(source: string): string {
  return source.split("/").slice(-2).join("/");
}

interface TitleText {
  readonly name: string;
  readonly of: string;
  readonly source: string | null;
  readonly icon?: IconName;
}

function titleOf(shell: Shell, selection: Shown): TitleText {
  const { page } = shell;
  if (selection.kind === "picked") return { name: selection.title, of: "", source: null };
  if (selection.kind === "world")
    return { name: page.world.manifest.value?.name ?? "world", of: "world", source: null };
  if (selection.kind === "light") return { name: selection.light, of: "light", source: null };
  if (selection.kind === "frame") return { name: selection.frame, of: "frame", source: null };
  if (selection.kind === "model")
    return { name: selection.model, of: "model", source: findModel(page, selection.model)?.source ?? null };
  if (selection.kind === "plugin") {
    const { of, plugin } = selection;
    const owner = of.kind === "world" ? "the world" : of.kind === "model" ? of.model : of.sensor;
    return { name: plugin, of: `plugin of ${owner}`, source: findPlugin(page, of, plugin)?.source ?? null };
  }
  if (selection.kind === "sensor") {
    const sensor = findSensor(page, selection.model, selection.link, selection.sensor);
    return {
      name: selection.sensor,
      of: `sensor of ${selection.model}::${selection.link}`,
      source: sensor?.source ?? null,
      icon: sensorIcon(sensor?.type ?? ""),
    };
  }
  const of = `${selection.kind} of ${selection.model}`;
  if (selection.kind === "link")
    return { name: selection.link, of, source: findLink(page, selection.model, selection.link)?.source ?? null };
  return { name: selection.joint, of, source: findJoint(page, selection.model, selection.joint)?.source ?? null };
}
