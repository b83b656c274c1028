/** Samples of the recording that the world is compared with. */

import { Euler, Quaternion, Vector3 } from "three";

import type { ReferenceInfo } from "../../protocol/generated/page_messages";

const POSE = 7;
const AXES = ["x", "y", "z"];
const ANGLES = ["roll", "pitch", "yaw"];
/** Numbers while interpolating. */
const [POSITION, TURN, OTHER] = [new Vector3(), new Quaternion(), new Quaternion()];
const EULER = new Euler();

/** Values over time, and whether they are angles that jump by 2π. */
export interface ReferenceSeries {
  /** Times since the recording's start, ascending [s]. */
  readonly times: Float64Array;
  readonly values: Float64Array;
  readonly isAngle: boolean;
}

export class ReferenceMotion {
  readonly times: Float64Array;
  /** Positions of joints, by sample and joint. */
  private readonly positions: Float64Array;
  /** Poses by sample and link: x y z, quaternion x y z w. */
  private readonly poses: Float32Array;
  /** Numbers of a bag's messages by path. */
  private readonly numbers = new Map<string, ReferenceSeries>();
  private readonly series = new Map<string, ReferenceSeries | null>();

  /** Throws a sentence if the data are truncated. */
  constructor(
    private readonly info: Pick<ReferenceInfo, "samples" | "links" | "joints" | "topics">,
    data: ArrayBuffer,
  ) {
    const { samples, links, joints, topics } = info;
    let numbers = samples * (1 + joints.length);
    const ofTopics = topics.reduce((sum, topic) => sum + topic.samples * (1 + topic.paths.length), 0);
    if (data.byteLength !== 8 * (numbers + ofTopics) + 4 * POSE * samples * links.length)
      throw new Error("it is incomplete");
    this.times = new Float64Array(data, 0, samples);
    this.positions = new Float64Array(data, 8 * samples, samples * joints.length);
    for (const topic of topics) {
      this.addTopic(topic, new Float64Array(data, 8 * numbers, topic.samples * (1 + topic.paths.length)));
      numbers += topic.samples * (1 + topic.paths.length);
    }
    this.poses = new Float32Array(data, 8 * numbers);
  }

  /** Write the interpolated pose of a link at a time since the start, held before the first sample and after the last. */
  pose(link: number, time: number, position: Vector3, orientation: Quaternion): void {
    const { times } = this;
    const after = Math.min(times.length - 1, Math.max(0, firstAfter(times, time)));
    const before = Math.max(0, after - 1);
    const [from = 0, to = 0] = [times[before], times[after]];
    const share = to > from ? Math.min(1, Math.max(0, (time - from) / (to - from))) : 1;
    this.read(before, link, position, orientation);
    this.read(after, link, POSITION, TURN);
    position.lerp(POSITION, share);
    orientation.slerp(TURN, share);
  }

  /** Values by their name in plots: `model::link.pose.x`, `/odom.twist.twist.linear.x`; null: it has none. */
  find(name: string): ReferenceSeries | null {
    if (name.startsWith("/")) return this.numbers.get(name) ?? this.element(name);
    const known = this.series.get(name);
    if (known !== undefined) return known;
    const found = this.compute(name);
    this.series.set(name, found);
    return found;
  }

  /** An element by its index of an array whose elements have names. */
  private element(name: string): ReferenceSeries | null {
    const [, array, index] = /^(.*\[)(\d+)\]$/.exec(name) ?? [];
    if (array === undefined) return null;
    const names = [...this.numbers.keys()].filter(
      (path) => path.startsWith(array) && path.indexOf("]") === path.length - 1,
    );
    return this.numbers.get(names[Number(index)] ?? "") ?? null;
  }

  /** `data`: the times of a topic's messages, then their numbers. */
  private addTopic({ topic, samples, paths }: ReferenceInfo["topics"][number], data: Float64Array): void {
    const times = data.subarray(0, samples);
    const width = paths.length;
    paths.forEach((path, at) => {
      if (this.numbers.has(topic + path)) return;
      const values = Float64Array.from(times, (_, row) => data[samples + row * width + at] ?? NaN);
      this.numbers.set(topic + path, { times, values, isAngle: false });
    });
  }

  private compute(name: string): ReferenceSeries | null {
    for (let dot = name.indexOf("."); dot >= 0; dot = name.indexOf(".", dot + 1)) {
      const owner = name.slice(0, dot);
      const [part = "", ...rest] = name.slice(dot + 1).split(".");
      const joint = this.info.joints.indexOf(owner);
      if (joint >= 0 && rest.length === 0) {
        const positions = this.sample((at) => this.positions[at * this.info.joints.length + joint] ?? NaN);
        if (part === "position") return this.seriesOf(positions);
        if (part === "velocity") return this.seriesOf(this.slope((at) => positions[at] ?? NaN));
      }
      const link = this.linkOf(owner);
      const found =
        link < 0 ? null : part === "pose" ? this.poseSeries(link, rest) : this.twistSeries(link, part, rest);
      if (found !== null) return found;
    }
    return null;
  }

  /** Index of a link, or of a model's first link; −1: it has none. */
  private linkOf(owner: string): number {
    const { links } = this.info;
    const exact = links.indexOf(owner);
    return exact >= 0 ? exact : links.findIndex((link) => link.split("::")[0] === owner);
  }

  private poseSeries(link: number, [field = ""]: readonly string[]): ReferenceSeries | null {
    const axis = AXES.indexOf(field);
    if (axis >= 0) return this.seriesOf(this.sample((at) => this.number(at, link, axis)));
    const angle = (["x", "y", "z"] as const)[ANGLES.indexOf(field)];
    if (angle === undefined) return null;
    const values = this.sample((at) => {
      this.read(at, link, POSITION, TURN);
      return EULER.setFromQuaternion(TURN, "ZYX")[angle];
    });
    return { ...this.seriesOf(values), isAngle: true };
  }

  /** Velocities, by differences. */
  private twistSeries(link: number, part: string, [kind, field = ""]: readonly string[]): ReferenceSeries | null {
    const axis = AXES.indexOf(field);
    if (part !== "twist" || axis < 0) return null;
    if (kind === "linear") return this.seriesOf(this.slope((at) => this.number(at, link, axis)));
    if (kind !== "angular") return null;
    const values = this.sample((at) => {
      const [before, after] = this.around(at);
      this.read(before, link, POSITION, OTHER);
      this.read(after, link, POSITION, TURN);
      TURN.multiply(OTHER.conjugate());
      const half = Math.acos(Math.min(1, Math.abs(TURN.w)));
      const scale = (TURN.w < 0 ? -2 : 2) * (half < 1e-9 ? 1 : half / Math.sin(half));
      return (scale * (TURN.toArray()[axis] ?? 0)) / this.span(before, after);
    });
    return this.seriesOf(values);
  }

  private seriesOf(values: Float64Array): ReferenceSeries {
    return { times: this.times, values, isAngle: false };
  }

  private sample(value: (at: number) => number): Float64Array {
    return Float64Array.from(this.times, (_, at) => value(at));
  }

  private slope(value: (at: number) => number): Float64Array {
    return this.sample((at) => {
      const [before, after] = this.around(at);
      return (value(after) - value(before)) / this.span(before, after);
    });
  }

  private around(at: number): readonly [number, number] {
    return [Math.max(0, at - 1), Math.min(this.times.length - 1, at + 1)];
  }

  private span(before: number, after: number): number {
    return (this.times[after] ?? 0) - (this.times[before] ?? 0) || Infinity;
  }

  private number(at: number, link: number, part: number): number {
    return this.poses[(at * this.info.links.length + link) * POSE + part] ?? NaN;
  }

  private read(at: number, link: number, position: Vector3, orientation: Quaternion): void {
    const start = (at * this.info.links.length + link) * POSE;
    position.fromArray(this.poses, start);
    orientation.fromArray(this.poses, start + 3);
  }
}

/** Index of the first time after a time; the length if there is none. */
export function firstAfter(times: Float64Array, time: number): number {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if ((times[middle] ?? Infinity) <= time) low = middle + 1;
    else high = middle;
  }
  return low;
}
