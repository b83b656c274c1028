/** Camera tiles at the bottom right; a press enlarges one over the scene, several side by side. */

import { useSignal } from "@preact/signals";
import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";

import type { PictureDisplay } from "../../displays/pictures/picture_display";
import { drawPicture, PictureStream, type PictureSource } from "../../displays/pictures/picture_stream";
import { Button } from "../../theme/button";
import { fixed } from "../../theme/format";
import { Name } from "../../theme/name";
import { SteadyNumber } from "../../theme/steady_number";
import { CameraSamples } from "./samples";
import { streamedTopic, tileKey, type CameraTopic } from "./topics";
import type { Shell } from "../shell";

export function CameraTiles({ shell }: { readonly shell: Shell }): JSX.Element | null {
  const cameras = shell.cameras.value;
  if (cameras.length === 0) return null;
  const enlarged = shell.enlarged.value;
  const large = cameras.filter((camera) => enlarged.has(tileKey(camera)));
  const toggle = (topic: string): void => {
    const topics = new Set(enlarged);
    if (!topics.delete(topic)) topics.add(topic);
    shell.enlarged.value = topics;
  };
  return (
    <>
      {large.length > 0 && (
        <div class="enlarged" style={{ "--columns": Math.ceil(Math.sqrt(large.length)) }}>
          {large.map((camera) => (
            <Tile key={tileKey(camera)} shell={shell} camera={camera} isLarge onPress={() => toggle(tileKey(camera))} />
          ))}
        </div>
      )}
      <div class="tiles" role="group" aria-label="Cameras">
        {cameras.map((camera) => (
          <Tile
            key={tileKey(camera)}
            shell={shell}
            camera={camera}
            isLarge={false}
            onPress={() => toggle(tileKey(camera))}
          />
        ))}
      </div>
    </>
  );
}

/** Pause after each picture [ms]: of a tile that is not live, and of a live one while the CPU draws the scene. */
const REST = 1000;
const SLOW_REST = 200;

interface TileProps {
  readonly shell: Shell;
  readonly camera: CameraTopic;
  readonly isLarge: boolean;
  readonly onPress: () => void;
}

function Tile({ shell, camera, isLarge, onPress }: TileProps): JSX.Element {
  const { connection, drive, scene } = shell.page;
  const tile = useRef<HTMLElement>(null);
  const isVisible = useVisible(tile);
  const isPointedAt = useSignal(false);
  const wasDrawn = useSignal(false);
  const { display } = camera;
  const topic =
    display === undefined ? streamedTopic(camera.topic, connection.topics.value, location.hostname) : camera.topic;
  const isLive = camera.rate === null || isLarge || isPointedAt.value || drive.command.value !== null;
  const rest = !isLive ? REST : scene.isSlow ? SLOW_REST : 0;
  const stream = useStream(shell, isVisible && display === undefined ? topic : null, rest);
  const source = display ?? stream;
  const fault = display === undefined ? (stream?.fault.value ?? null) : displayFault(display);
  const hertz = !wasDrawn.value
    ? null
    : rest === 0 || display !== undefined
      ? connection.statistics(topic).rate
      : camera.rate;
  return (
    <figure
      ref={tile}
      class={isLarge ? "tile float large" : "tile float"}
      onPointerEnter={() => (isPointedAt.value = true)}
      onPointerLeave={() => (isPointedAt.value = false)}
    >
      <button
        type="button"
        class="shot"
        aria-label={`${isLarge ? "Make smaller" : "Enlarge"} ${camera.name}`}
        onClick={onPress}
      >
        {source !== null && <Canvas source={source} name={camera.name} onDrawn={() => (wasDrawn.value = true)} />}
      </button>
      {fault !== null && <span class="said fault">{fault}</span>}
      {fault === null && !wasDrawn.value && <span class="said t2 sm">No picture yet</span>}
      <figcaption class="cap">
        <Name text={camera.name} />
        <span class="r">
          {hertz !== null && hertz >= 0.5 && (
            <>
              <SteadyNumber text={fixed(hertz, 0)} length={2} /> Hz
            </>
          )}
        </span>
        <VideoButton shell={shell} topic={topic} name={camera.name} />
        <Button
          icon={isLarge ? "close" : "enlarge"}
          label={`${isLarge ? "Make smaller" : "Enlarge"} ${camera.name}`}
          onClick={onPress}
        />
      </figcaption>
    </figure>
  );
}

/** Records the camera's own pictures, in the time of their stamps. */
function VideoButton({
  shell,
  topic,
  name,
}: {
  readonly shell: Shell;
  readonly topic: string;
  readonly name: string;
}): JSX.Element {
  const { videos } = shell;
  const isRecorded = videos.has(topic);
  const label = isRecorded ? `Stop and save the video of ${name}` : `Record a video of ${name}`;
  return (
    <Button icon="record" class="rec" label={label} on={isRecorded} onClick={() => videos.toggleCamera(topic, name)} />
  );
}

/** Most severe fault of a display's picture. */
function displayFault(display: PictureDisplay): string | null {
  const fault = [...display.statuses.value.values()].find(({ level }) => level === "error");
  return fault?.text ?? null;
}

/** Pictures of a topic with pauses between them [ms]; 0: all pictures. The last picture stays until the next. */
function useStream(shell: Shell, topic: string | null, rest: number): PictureStream | CameraSamples | null {
  const [stream, setStream] = useState<PictureStream | CameraSamples | null>(null);
  useEffect(() => {
    if (topic === null) return undefined;
    const { connection } = shell.page;
    const opened = rest === 0 ? new PictureStream(connection, topic) : new CameraSamples(connection, topic, rest);
    setStream(opened);
    return () => {
      setStream(null);
      opened.close();
    };
  }, [shell, topic, rest]);
  return stream;
}

/** True while any part of an element is visible in a visible page, so that tiles out of sight cost nothing. */
function useVisible(element: { readonly current: HTMLElement | null }): boolean {
  const [isInSight, setInSight] = useState(false);
  const [isHidden, setHidden] = useState(document.hidden);
  useEffect(() => {
    if (element.current === null) return undefined;
    const observer = new IntersectionObserver((entries) => setInSight(entries.at(-1)?.isIntersecting ?? false));
    const look = (): void => setHidden(document.hidden);
    observer.observe(element.current);
    document.addEventListener("visibilitychange", look);
    return () => {
      observer.disconnect();
      document.removeEventListener("visibilitychange", look);
    };
  }, [element]);
  return isInSight && !isHidden;
}

interface CanvasProps {
  readonly source: PictureSource;
  readonly name: string;
  readonly onDrawn: () => void;
}

/** Canvas with a source's pictures; the old source's last picture stays until the new source has one. */
function Canvas({ source, name, onDrawn }: CanvasProps): JSX.Element {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(
    () =>
      source.picture.subscribe((picture) => {
        if (canvas.current === null || picture === null) return;
        drawPicture(canvas.current, picture);
        onDrawn();
      }),
    [source],
  );
  return <canvas ref={canvas} role="img" aria-label={`Camera image ${name}`} />;
}
