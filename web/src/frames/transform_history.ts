/** Transforms of one frame in its parent, over the last seconds, as tf2's caches keep them. */

import { Quaternion, Vector3 } from "three";

import { ArrivalStatistics } from "../protocol/topic_statistics";

/** Pose of a frame in its parent at one time. */
export interface Sample {
  /** [ns] */
  readonly stamp: bigint;
  readonly parent: string;
  readonly position: Vector3;
  readonly orientation: Quaternion;
}

/** [ns]; tf2's default. */
const CACHE_TIME = 10_000_000_000n;
/** Bounds the memory of a frame that is published faster than any robot does: 10 s at 1 kHz. */
const MAX_SAMPLES = 10_000;

export class TransformHistory {
  /** Arrivals of transforms, of whatever stamps. */
  readonly arrivals = new ArrivalStatistics();
  /** Oldest first, each stamp once. */
  readonly #samples: Sample[];

  constructor(first: Sample) {
    this.#samples = [first];
    this.arrivals.add(performance.now(), 0);
  }

  get oldest(): Sample {
    return this.#at(0);
  }

  get newest(): Sample {
    return this.#at(this.#samples.length - 1);
  }

  /** Add a transform; one older than the cache is dropped. */
  add(sample: Sample): void {
    this.arrivals.add(performance.now(), 0);
    const samples = this.#samples;
    if (sample.stamp > this.newest.stamp) samples.push(sample);
    else if (sample.stamp < this.newest.stamp - CACHE_TIME) return;
    else {
      const at = this.#firstNotBefore(sample.stamp);
      samples.splice(at, this.#at(at).stamp === sample.stamp ? 1 : 0, sample);
    }
    while (samples.length > MAX_SAMPLES || this.oldest.stamp < this.newest.stamp - CACHE_TIME) samples.shift();
  }

  /** Transform at a time [ns], interpolated, or tf2's extrapolation error. */
  lookup(stamp: bigint): Sample | string {
    const { oldest, newest } = this;
    if (stamp > newest.stamp || stamp < oldest.stamp) return extrapolation(stamp, oldest.stamp, newest.stamp);
    const at = this.#firstNotBefore(stamp);
    const after = this.#at(at);
    if (after.stamp === stamp) return after;
    const before = this.#at(at - 1);
    if (before.parent !== after.parent) return before;
    const share = Number(stamp - before.stamp) / Number(after.stamp - before.stamp);
    return {
      stamp,
      parent: before.parent,
      position: new Vector3().lerpVectors(before.position, after.position, share),
      orientation: new Quaternion().slerpQuaternions(before.orientation, after.orientation, share),
    };
  }

  /** Index of the first sample that is not older than a stamp, which is at most the newest sample's. */
  #firstNotBefore(stamp: bigint): number {
    let low = 0;
    let high = this.#samples.length - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.#at(middle).stamp < stamp) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  #at(index: number): Sample {
    return this.#samples[index] as Sample; // there is always a sample, and every index is valid
  }
}

function extrapolation(stamp: bigint, oldest: bigint, newest: bigint): string {
  const requested = secondsText(stamp);
  if (oldest === newest) {
    return `Lookup would require extrapolation at time ${requested}, but only time ${secondsText(newest)} is in the buffer`;
  }
  const [direction, bound, limit] = stamp > newest ? ["future", "latest", newest] : ["past", "earliest", oldest];
  return (
    `Lookup would require extrapolation into the ${direction}. Requested time ${requested} ` +
    `but the ${bound} data is at time ${secondsText(limit)}`
  );
}

/** Seconds with nine decimals, as ROS prints times. */
function secondsText(stamp: bigint): string {
  const digits = stamp.toString().padStart(10, "0");
  return `${digits.slice(0, -9)}.${digits.slice(-9)}`;
}
