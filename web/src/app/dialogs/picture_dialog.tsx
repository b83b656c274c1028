/** Saves the view as a picture of any size. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";

import { saveFile, sentence } from "../../panels/use";
import { Button } from "../../theme/button";
import { NumberField } from "../../theme/number_field";
import { Dialog } from "./dialog";
import type { Shell } from "../shell";

/** Longest edge that browsers draw [px]. */
const LONGEST = 8192;
const SIZES = [
  [1280, 720],
  [1920, 1080],
  [3840, 2160],
] as const;

export function PictureDialog({ shell }: { readonly shell: Shell }): JSX.Element {
  const { scene, session } = shell.page;
  const sceneSize = scene.size.value;
  const size = useSignal<readonly [number, number]>([Math.round(sceneSize.width), Math.round(sceneSize.height)]);
  const fault = useSignal("");
  const [width, height] = size.value;
  const close = (): void => {
    shell.dialog.value = null;
  };
  const save = async (): Promise<void> => {
    try {
      const picture = scene.picture(width, height);
      const png = await new Promise<Blob | null>((resolve) => picture.toBlob(resolve, "image/png"));
      if (png === null) throw new Error("The browser has not enough memory for a picture of this size.");
      saveFile(`${session.title}.png`, png);
      close();
    } catch (error) {
      fault.value = sentence(error);
    }
  };
  const field = (label: string, value: number, onCommit: (value: number) => void): JSX.Element => (
    <label class="row">
      <span class="t2">{label}</span>
      <NumberField label={label} value={value} unit="px" integer min={16} max={LONGEST} onCommit={onCommit} />
    </label>
  );
  return (
    <Dialog title="Save a picture" class="save" onClose={close}>
      <div class="form">
        {field("Width", width, (value) => (size.value = [value, height]))}
        {field("Height", height, (value) => (size.value = [width, value]))}
        <div class="sides">
          {SIZES.map(([w, h]) => (
            <Button key={w} small tone="line" on={w === width && h === height} onClick={() => (size.value = [w, h])}>
              {w} × {h}
            </Button>
          ))}
        </div>
      </div>
      <div class="foot">
        <span class="sm" role="alert">
          {fault.value}
        </span>
        <span class="sp" />
        <Button tone="line" icon="download" onClick={() => void save()}>
          Save as PNG
        </Button>
      </div>
    </Dialog>
  );
}
