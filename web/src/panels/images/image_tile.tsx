/** A picture of a topic: fitted or pixel by pixel, with the value under the cursor. */

import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";

import { drawPicture, PictureStream } from "../../displays/pictures/picture_stream";
import type { Connection } from "../../protocol/connection";
import type { CompressedImage, Image } from "../../protocol/generated/ros_messages";
import { Button } from "../../theme/button";
import { Name } from "../../theme/name";
import { Select } from "../../theme/select";
import { exact } from "../messages/format";
import { saveFile } from "../use";
import { pixelValue } from "./pixel_value";

interface ImageTileProps {
  readonly connection: Connection;
  readonly topic: string;
  readonly isEnlarged: boolean;
  readonly onEnlarge: () => void;
  readonly onClose: () => void;
}

const ZOOMS: Readonly<Record<string, number | null>> = {
  Fit: null,
  "50 %": 0.5,
  "1 : 1": 1,
  "200 %": 2,
  "400 %": 4,
  "800 %": 8,
};

interface Newest {
  message: Image | CompressedImage | null;
}

export function ImageTile({ connection, topic, isEnlarged, onEnlarge, onClose }: ImageTileProps): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [stream, setStream] = useState<PictureStream | null>(null);
  const [zoom, setZoom] = useState("Fit");
  const [pixel, setPixel] = useState<readonly [number, number] | null>(null);
  const newest = useRef<Newest>({ message: null });
  useEffect(() => {
    const opened = new PictureStream(connection, topic);
    const raw = connection.subscribe<Image | CompressedImage>(
      topic,
      ({ message }) => void (newest.current.message = message),
    );
    const drawn = opened.picture.subscribe((picture) => {
      if (picture !== null && canvas.current !== null) drawPicture(canvas.current, picture);
    });
    setStream(opened);
    return () => {
      drawn();
      raw.close();
      opened.close();
    };
  }, [connection, topic]);
  const picture = stream?.picture.value ?? null;
  const fault = stream?.fault.value ?? null;
  const factor = ZOOMS[zoom] ?? null;
  const size = picture === null ? "" : `${picture.width} × ${picture.height} ${stream?.encoding.value ?? ""}`;
  return (
    <figure class="imagetile">
      <div class={factor === null ? "picture fit" : "picture"} onDblClick={onEnlarge}>
        {picture === null && <div class="empty">{fault ?? "No image yet."}</div>}
        <canvas
          ref={canvas}
          role="img"
          aria-label={`Picture of ${topic}`}
          class={factor !== null && factor > 1 ? "pixels" : ""}
          style={
            factor === null || picture === null
              ? {}
              : { width: `${picture.width * factor}px`, height: `${picture.height * factor}px` }
          }
          hidden={picture === null}
          onPointerMove={(event) => setPixel(pixelAt(event))}
          onPointerLeave={() => setPixel(null)}
        />
      </div>
      <figcaption class="toolrow">
        <Name text={topic} />
        <span class="dim sm n">{pixel === null ? size : pixelText(newest.current.message, canvas.current, pixel)}</span>
        <span class="sp" />
        <Select label={`Zoom of ${topic}`} value={zoom} choices={Object.keys(ZOOMS)} onChange={setZoom} />
        <Button
          small
          icon="download"
          label={`Save ${topic} as PNG`}
          disabled={picture === null}
          onClick={() => save(canvas.current, topic)}
        />
        <Button
          small
          icon="enlarge"
          label={isEnlarged ? `Show ${topic} beside the others` : `Enlarge ${topic}`}
          on={isEnlarged}
          onClick={onEnlarge}
        />
        <Button small icon="close" label={`Close ${topic}`} onClick={onClose} />
      </figcaption>
      {picture !== null && fault !== null && (
        <div class="fault pad" role="alert">
          {fault}
        </div>
      )}
    </figure>
  );
}

function pixelAt(event: PointerEvent & { readonly currentTarget: HTMLCanvasElement }): readonly [number, number] {
  const { width, height } = event.currentTarget;
  const box = event.currentTarget.getBoundingClientRect();
  return [
    Math.floor(((event.clientX - box.left) / box.width) * width),
    Math.floor(((event.clientY - box.top) / box.height) * height),
  ];
}

/** "12, 30: r 255 g 0 b 0"; of a compressed picture its color. */
function pixelText(
  message: Image | CompressedImage | null,
  canvas: HTMLCanvasElement | null,
  [x, y]: readonly [number, number],
): string {
  const values = message !== null && "encoding" in message ? pixelValue(message, x, y) : shownColor(canvas, x, y);
  const text = values?.map(([name, value]) => `${name} ${exact(value)}`.trim()).join("  ") ?? "";
  return `${x}, ${y}: ${text}`;
}

function shownColor(
  canvas: HTMLCanvasElement | null,
  x: number,
  y: number,
): readonly (readonly [string, number])[] | null {
  const data = canvas?.getContext("2d")?.getImageData(x, y, 1, 1).data;
  return data === undefined ? null : ["r", "g", "b"].map((name, index) => [name, data[index] ?? 0]);
}

function save(canvas: HTMLCanvasElement | null, topic: string): void {
  canvas?.toBlob((blob) => {
    if (blob !== null) saveFile(`${topic.replace(/^\//, "").replace(/\//g, "_")}.png`, blob);
  }, "image/png");
}
