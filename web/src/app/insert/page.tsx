/** The Insert page: shapes, lights and the models of the model path. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect } from "preact/hooks";

import { Button } from "../../theme/button";
import { Icon, type IconName } from "../../theme/icons";
import type { Insertable } from "../../page/insertable";
import { InsertButton } from "./button";
import { TypedPosition } from "./typed_position";
import type { ModelEntry } from "../../protocol/generated/page_messages";
import { pictureUrl } from "../../protocol/picture_urls";
import type { Shell } from "../shell";

const SIMPLE: readonly { readonly icon: IconName; readonly label: string; readonly item: Insertable }[] = [
  { icon: "model", label: "box", item: { kind: "shape", name: "box", title: "box" } },
  { icon: "sphere", label: "sphere", item: { kind: "shape", name: "sphere", title: "sphere" } },
  { icon: "cylinder", label: "cylinder", item: { kind: "shape", name: "cylinder", title: "cylinder" } },
  { icon: "light", label: "point", item: { kind: "light", name: "point", title: "point light" } },
  { icon: "sun", label: "directional", item: { kind: "light", name: "directional", title: "directional light" } },
  { icon: "spot", label: "spot", item: { kind: "light", name: "spot", title: "spot light" } },
];

export function InsertPage({ shell }: { readonly shell: Shell }): JSX.Element {
  const { insertion } = shell;
  const search = useSignal("");
  useEffect(() => insertion.list(), [insertion]);
  const models = insertion.models.value;
  const query = search.value.trim().toLowerCase();
  const matches = (models ?? []).filter(({ name, title }) => `${name} ${title}`.toLowerCase().includes(query));
  const message =
    models === null
      ? "Looking for models."
      : models.length === 0
        ? "There are no models on the model path."
        : "No matching model.";
  return (
    <>
      <div class="simple" role="group" aria-label="Simple shapes and lights">
        {SIMPLE.map(({ icon, label, item }) => (
          <InsertButton key={item.title} shell={shell} item={item} class="b">
            <Icon name={icon} />
            {label}
          </InsertButton>
        ))}
      </div>
      <div class="search">
        <label class="field find">
          <Icon name="find" />
          <input
            type="search"
            placeholder="Search the models"
            aria-label="Search the models"
            onInput={(event) => (search.value = event.currentTarget.value)}
          />
        </label>
        <Button icon="upload" label="Upload a model" onClick={() => insertion.upload.open()} />
      </div>
      <div class="scroll models" role="group" aria-label="Models">
        {matches.length === 0 && <p class="empty">{message}</p>}
        {matches.map((model) => (
          <ModelButton key={model.name} shell={shell} model={model} />
        ))}
      </div>
      {insertion.typed.value !== null && <TypedPosition shell={shell} item={insertion.typed.value} />}
    </>
  );
}

function ModelButton({ shell, model }: { readonly shell: Shell; readonly model: ModelEntry }): JSX.Element {
  const { name, title, description, uploaded } = model;
  const version = uploaded ? shell.insertion.upload.count.value : 0;
  return (
    <InsertButton
      shell={shell}
      item={{ kind: "model", name, title }}
      class="model"
      tip={description === "" ? title : `${title}: ${description}`}
    >
      <Picture key={version} name={name} version={version} />
      <span>{title}</span>
    </InsertButton>
  );
}

/** The server's picture of a model, loaded once it is visible. */
function Picture({ name, version }: { readonly name: string; readonly version: number }): JSX.Element {
  const failed = useSignal(false);
  if (failed.value) return <Icon name="model" />;
  return (
    <img
      src={pictureUrl("model.png", { model: name }, version)}
      alt=""
      loading="lazy"
      draggable={false}
      onError={() => (failed.value = true)}
    />
  );
}
