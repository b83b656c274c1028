/** Section Scene Objects of the panel MotionPlanning: objects that paths avoid. */

import { signal } from "@preact/signals";
import type { JSX } from "preact";

import { Controls } from "../../page/view_only";
import type { AttachedCollisionObject, CollisionObject } from "../../protocol/generated/ros_messages";
import { Button } from "../../theme/button";
import { MenuButton } from "../../theme/menu";
import { NumberField } from "../../theme/number_field";
import { Select } from "../../theme/select";
import { TextField } from "../../theme/text_field";
import { perPage } from "../per_page";
import { FormRow, type TabProps } from "./parts";
import { rpyOf, SceneObjects, type ShapeName } from "./scene_objects";

const SHAPES: readonly ShapeName[] = ["box", "sphere", "cylinder", "cone"];
const PARTS = ["x", "y", "z", "Roll", "Pitch", "Yaw"] as const;
const DIMENSIONS: Readonly<Record<number, readonly string[]>> = {
  1: ["Size x", "Size y", "Size z"],
  2: ["Radius"],
  3: ["Height", "Radius"],
  4: ["Height", "Radius"],
};
const DEGREES = 180 / Math.PI;
const MESHES = ".stl,.dae,.obj,.glb,.gltf";

const shownMeshField = perPage(() => signal(false));

interface ObjectProps extends TabProps {
  readonly objects: SceneObjects;
}

export function ObjectsTab(props: TabProps): JSX.Element {
  const { page, state, display } = props;
  const objects = new SceneObjects(state, display);
  const { objects: free, attached } = display.drafted.value;
  const { selected, count } = display.draft;
  const object = free.get(selected.value ?? "");
  return (
    <div class="split">
      <div class="main">
        <Controls page={page}>
          <Head {...props} objects={objects} />
        </Controls>
        {free.size + attached.size === 0 && <div class="empty">The scene has no objects.</div>}
        <div
          class="scroll objectlist"
          {...(free.size > 0 && ({ role: "listbox", "aria-label": "Scene objects" } as const))}
        >
          {[...free.keys()].map((id) => (
            <button
              key={id}
              type="button"
              role="option"
              aria-selected={id === selected.value}
              class={id === selected.value ? "row sel" : "row"}
              onClick={() => void (selected.value = id === selected.value ? null : id)}
            >
              <span class="n">{id}</span>
              {display.draft.changes.value.objects.has(id) && <span class="r">not published</span>}
            </button>
          ))}
        </div>
        {attached.size > 0 && (
          <ul class="objectlist" aria-label="Attached objects">
            {[...attached.values()].map((body) => (
              <AttachedRow key={body.object.id} {...props} objects={objects} body={body} />
            ))}
          </ul>
        )}
        {count.value > 0 && (
          <div class="toolrow">
            <span class="sm t2">
              {count.value === 1 ? "1 change, not published" : `${count.value} changes, not published`}
            </span>
            <span class="sp" />
            <Button small onClick={() => display.draft.edit("Discard the scene's changes", NOTHING)}>
              Discard
            </Button>
            <Button small tone="primary" icon="upload" onClick={() => void objects.publish()}>
              Publish
            </Button>
          </div>
        )}
      </div>
      <div class="detail">
        {object === undefined ? (
          <div class="empty">Choose an object to move, scale or attach it.</div>
        ) : (
          <Controls page={page}>
            <Details {...props} objects={objects} object={object} />
          </Controls>
        )}
      </div>
    </div>
  );
}

const NOTHING = { objects: new Map(), attached: new Map() } as const;

function Head({ page, objects }: ObjectProps): JSX.Element {
  const isTyping = shownMeshField(page);
  return (
    <>
      <div class="toolrow">
        <MenuButton
          icon="plus"
          label="Add an object"
          items={() => [
            ...SHAPES.map((shape) => ({ title: named(shape), run: () => objects.addShape(shape) })),
            { title: "Mesh of a file", run: () => pick(MESHES, (file) => void addFile(objects, file)) },
            { title: "Mesh of an address", run: () => void (isTyping.value = true) },
          ]}
        >
          Add
        </MenuButton>
        <span class="sp" />
        <Button
          small
          icon="upload"
          onClick={() => pick(".scene", (file) => void file.text().then((text) => objects.importFile(file.name, text)))}
        >
          Import
        </Button>
        <Button small icon="download" onClick={() => objects.exportFile()}>
          Export
        </Button>
      </div>
      {isTyping.value && (
        <div class="toolrow">
          <TextField
            label="Address of a mesh"
            class="small"
            value=""
            placeholder="package://robot/meshes/cup.stl"
            onCommit={(uri) => {
              isTyping.value = false;
              if (uri.trim() !== "") void objects.addMesh(uri.trim());
            }}
          />
        </div>
      )}
    </>
  );
}

function Details({ display, objects, object }: ObjectProps & { readonly object: CollisionObject }): JSX.Element {
  const { x, y, z } = object.pose.position;
  const values = [x, y, z, ...rpyOf(object.pose)];
  const links = display.model?.robot.links.map(({ name }) => name) ?? [];
  const [tip = ""] = display.group.value?.tips ?? [];
  return (
    <div class="scroll">
      <h2 class="headline">{object.id}</h2>
      {PARTS.map((label, part) => {
        const isAngle = part > 2;
        return (
          <FormRow key={label} label={label}>
            <span class="narrow">
              <NumberField
                label={label}
                unit={isAngle ? "°" : "m"}
                class="small num"
                decimals={isAngle ? 1 : 3}
                value={(values[part] ?? 0) * (isAngle ? DEGREES : 1)}
                onCommit={(value) => objects.place(object, part, isAngle ? value / DEGREES : value)}
              />
            </span>
          </FormRow>
        );
      })}
      {object.primitives.flatMap((shape, index) =>
        (DIMENSIONS[shape.type] ?? []).map((label, dimension) => (
          <FormRow key={`${index} ${label}`} label={label}>
            <span class="narrow">
              <NumberField
                label={label}
                unit="m"
                class="small num"
                decimals={3}
                min={0.001}
                value={shape.dimensions[dimension] ?? 0}
                onCommit={(value) => objects.resize(object, index, dimension, value)}
              />
            </span>
          </FormRow>
        )),
      )}
      <FormRow label="Scale">
        <span class="narrow">
          <NumberField
            label="Scale"
            unit="%"
            class="small num"
            min={1}
            value={100}
            onCommit={(value) => objects.scale(object, value / 100)}
          />
        </span>
      </FormRow>
      <FormRow label="Attach to">
        <Select
          label="Attach to"
          value="no link"
          choices={["no link", ...(tip === "" ? [] : [tip]), ...links.filter((link) => link !== tip)]}
          onChange={(link) => link !== "no link" && objects.attach(object, link)}
        />
      </FormRow>
      <div class="formrow">
        <Button small icon="close" onClick={() => objects.remove(object.id)}>
          Remove
        </Button>
      </div>
    </div>
  );
}

function AttachedRow({ page, objects, body }: ObjectProps & { readonly body: AttachedCollisionObject }): JSX.Element {
  return (
    <li class="row">
      <span class="n">{body.object.id}</span>
      <span class="r">on {body.link_name}</span>
      <Controls page={page}>
        <Button small label={`Detach ${body.object.id}`} onClick={() => objects.detach(body)}>
          Detach
        </Button>
      </Controls>
    </li>
  );
}

function named(shape: ShapeName): string {
  return `${shape.slice(0, 1).toUpperCase()}${shape.slice(1)}`;
}

/** Ask for a file of the person's machine. */
function pick(accept: string, onFile: (file: File) => void): void {
  const input = document.createElement("input");
  input.type = "file";
  input.accept = accept;
  input.addEventListener("change", () => {
    const file = input.files?.[0];
    if (file !== undefined) onFile(file);
  });
  input.click();
}

async function addFile(objects: SceneObjects, file: File): Promise<void> {
  await objects.addMesh(file.name, await file.arrayBuffer());
}
