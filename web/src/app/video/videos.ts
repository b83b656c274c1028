/** The videos that are being recorded: of the view, of cameras. */

import { signal } from "@preact/signals";

import { saveFile, sentence } from "../../panels/use";
import type { Notices } from "../notices/notices";
import type { Page } from "../../page/page";
import { recordCamera } from "./camera_video";
import { Recording } from "./recording";
import { recordView } from "./view_video";

export interface RunningVideo {
  /** Topic of the camera; "": the view. */
  readonly topic: string;
  /** "the view", or the camera's name. */
  readonly title: string;
  readonly recording: Recording;
  readonly stop: () => void;
}

export class Videos {
  readonly running = signal<readonly RunningVideo[]>([]);

  constructor(
    private readonly page: Page,
    private readonly notices: Notices,
  ) {}

  /** Record the view, or end that and hand the file to the person. */
  toggleView(): void {
    this.toggle("", "the view", (recording) => recordView(this.page.scene, recording));
  }

  /** Record a camera, by its topic, or end that and hand the file to the person. */
  toggleCamera(topic: string, name: string): void {
    this.toggle(topic, name, (recording) => recordCamera(this.page.connection, topic, recording));
  }

  /** True if a camera is being recorded, by its topic; "": the view. */
  has(topic: string): boolean {
    return this.running.value.some((video) => video.topic === topic);
  }

  async save(video: RunningVideo): Promise<void> {
    if (!this.running.peek().includes(video)) return;
    this.running.value = this.running.peek().filter((other) => other !== video);
    video.stop();
    try {
      const { content, suffix } = await video.recording.finish();
      const name = video.topic === "" ? "" : `_${video.title.replace(/[^\w.-]+/g, "_")}`;
      saveFile(`${this.page.session.title}${name}.${suffix}`, content);
    } catch (error) {
      this.notices.report("Video", sentence(error));
    }
  }

  private toggle(topic: string, title: string, start: (recording: Recording) => () => void): void {
    const running = this.running.peek().find((video) => video.topic === topic);
    if (running !== undefined) {
      void this.save(running);
      return;
    }
    const recording = new Recording(() => void this.save(video));
    const video: RunningVideo = { topic, title, recording, stop: start(recording) };
    this.running.value = [...this.running.peek(), video];
  }
}
