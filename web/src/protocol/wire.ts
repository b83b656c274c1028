/** Frames of the Foxglove protocol (v1 of its published specification) and of `trundle.v1`. */

import { fault } from "./check";
import type { ClientOperation } from "./generated/page_messages";

export const SUBPROTOCOLS = ["trundle.v1", "foxglove.websocket.v1"];

/** Binary frames of the server. */
export type ServerBinary =
  | {
      readonly op: "message";
      readonly subscription: number;
      readonly time: bigint;
      /** Wall time of the server when it had the message [ms]. */
      readonly serverTime: number;
      readonly payload: DataView;
    }
  /** The page echoes a mark once it has handled all frames before it. */
  | { readonly op: "mark"; readonly mark: number; readonly serverTime: number }
  | { readonly op: "time"; readonly time: bigint }
  | { readonly op: "serviceResponse"; readonly call: number; readonly payload: DataView }
  | { readonly op: "asset"; readonly request: number; readonly error: string | null; readonly data: ArrayBuffer };

/** Text frames of the client, and binary ones. */
export type ClientFrame = ClientOperation | ArrayBuffer;

/** Sends a frame; false: there is no connection. */
export type Send = (frame: ClientFrame) => boolean;

/** Read a binary frame. Throws a `MessageFault`. */
export function readBinary(frame: ArrayBuffer): ServerBinary {
  try {
    return binaryOf(frame, new DataView(frame));
  } catch (error) {
    throw error instanceof RangeError ? fault("a binary message", "it is cut off") : error;
  }
}

function binaryOf(frame: ArrayBuffer, view: DataView): ServerBinary {
  switch (view.getUint8(0)) {
    case 0x81:
      return {
        op: "message",
        subscription: view.getUint32(1, true),
        time: view.getBigUint64(5, true),
        serverTime: milliseconds(view, 13),
        payload: new DataView(frame, 21),
      };
    case 0x82:
      return { op: "mark", mark: view.getUint32(1, true), serverTime: milliseconds(view, 5) };
    case 2:
      return { op: "time", time: view.getBigUint64(1, true) };
    case 3: {
      const encoding = view.getUint32(9, true);
      return { op: "serviceResponse", call: view.getUint32(5, true), payload: new DataView(frame, 13 + encoding) };
    }
    case 4: {
      const end = 10 + view.getUint32(6, true);
      const error = new TextDecoder().decode(new Uint8Array(frame, 10, end - 10));
      const request = view.getUint32(1, true);
      return { op: "asset", request, error: view.getUint8(5) === 0 ? null : error, data: frame.slice(end) };
    }
    default:
      throw fault("a binary message", `its opcode is the unknown ${view.getUint8(0)}`);
  }
}

/** Nanoseconds at an offset, in milliseconds. */
function milliseconds(view: DataView, offset: number): number {
  return Number(view.getBigUint64(offset, true) / 1000n) / 1000;
}

/** Client Message Data. */
export function messageFrame(channel: number, payload: Uint8Array): ArrayBuffer {
  const frame = new Uint8Array(5 + payload.length);
  const view = new DataView(frame.buffer);
  view.setUint8(0, 1);
  view.setUint32(1, channel, true);
  frame.set(payload, 5);
  return frame.buffer;
}

/** Service Call Request. */
export function callFrame(service: number, call: number, payload: Uint8Array): ArrayBuffer {
  const encoding = new TextEncoder().encode("ros1");
  const frame = new Uint8Array(13 + encoding.length + payload.length);
  const view = new DataView(frame.buffer);
  view.setUint8(0, 2);
  view.setUint32(1, service, true);
  view.setUint32(5, call, true);
  view.setUint32(9, encoding.length, true);
  frame.set(encoding, 13);
  frame.set(payload, 13 + encoding.length);
  return frame.buffer;
}
