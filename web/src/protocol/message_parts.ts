/** Long messages, which the server sends in parts so that short messages can overtake them. */

import { fault } from "./check";

/** Opcode of a part. */
const PART = 0x80;
/** Opcode, u32 number of the stream, u8 last, u8 text. */
const HEADER = 7;

export class MessageParts {
  /** Stream → parts of its unfinished message. */
  readonly #parts = new Map<number, Uint8Array[]>();

  /** Message of a frame; null: parts are missing. Throws a `MessageFault`. */
  join(frame: ArrayBuffer): string | ArrayBuffer | null {
    const view = new DataView(frame);
    if (frame.byteLength === 0 || view.getUint8(0) !== PART) return frame;
    if (frame.byteLength < HEADER) throw fault("a binary message", "it is cut off");
    const stream = view.getUint32(1, true);
    const parts = this.#parts.get(stream) ?? [];
    this.#parts.set(stream, parts);
    parts.push(new Uint8Array(frame, HEADER));
    if (view.getUint8(5) === 0) return null;
    this.#parts.delete(stream);
    const whole = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
    let end = 0;
    for (const part of parts) {
      whole.set(part, end);
      end += part.length;
    }
    return view.getUint8(6) === 0 ? whole.buffer : new TextDecoder().decode(whole);
  }

  /** Forget unfinished messages: their connection is lost. */
  clear(): void {
    this.#parts.clear();
  }
}
