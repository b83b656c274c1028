/** Frames of the Foxglove protocol (v1 of its published specification) and of `trundle.v1`. */

import type { ParameterValue, RequestAnswer } from "./connection";

export const SUBPROTOCOLS = ["trundle.v1", "foxglove.websocket.v1"];

export interface Channel {
  readonly id: number;
  readonly topic: string;
  readonly encoding: string;
  readonly schemaName: string;
  readonly schema: string;
}

interface ServicePart {
  readonly schemaName: string;
  readonly schema: string;
}

export interface Service {
  readonly id: number;
  readonly name: string;
  readonly type: string;
  readonly request?: ServicePart;
  readonly response?: ServicePart;
  readonly requestSchema?: string;
  readonly responseSchema?: string;
}

export interface Parameter {
  readonly name: string;
  /** Absent: the parameter is not set. */
  readonly value?: ParameterValue;
  readonly type?: "byte_array" | "float64" | "float64_array";
}

export interface GraphUpdate {
  readonly publishedTopics: readonly { readonly name: string; readonly publisherIds: readonly string[] }[];
  readonly subscribedTopics: readonly {
    readonly name: string;
    readonly subscriberIds: readonly string[];
    readonly type?: string;
  }[];
  readonly advertisedServices: readonly { readonly name: string; readonly providerIds: readonly string[] }[];
  readonly removedTopics: readonly string[];
  readonly removedServices: readonly string[];
}

/** Text frames of the server. */
export type ServerText =
  | { readonly op: "serverInfo"; readonly name: string; readonly capabilities: readonly string[] }
  | { readonly op: "status"; readonly level: number; readonly message: string; readonly id?: string }
  | { readonly op: "removeStatus"; readonly statusIds: readonly string[] }
  | { readonly op: "advertise"; readonly channels: readonly Channel[] }
  | { readonly op: "unadvertise"; readonly channelIds: readonly number[] }
  | { readonly op: "advertiseServices"; readonly services: readonly Service[] }
  | { readonly op: "unadvertiseServices"; readonly serviceIds: readonly number[] }
  | { readonly op: "parameterValues"; readonly parameters: readonly Parameter[] }
  | ({ readonly op: "connectionGraphUpdate" } & GraphUpdate)
  | { readonly op: "serviceCallFailure"; readonly callId: number; readonly message: string }
  | ({ readonly op: "trundle/response"; readonly id: number; readonly ok: true } & RequestAnswer)
  | { readonly op: "trundle/response"; readonly id: number; readonly ok: false; readonly error: string };

/** Binary frames of the server. */
export type ServerBinary =
  | { readonly op: "message"; readonly subscription: number; readonly time: bigint; readonly payload: DataView }
  | { readonly op: "time"; readonly time: bigint }
  | { readonly op: "serviceResponse"; readonly call: number; readonly payload: DataView }
  | { readonly op: "asset"; readonly request: number; readonly error: string | null; readonly data: ArrayBuffer };

/** Text frames of the client, and binary ones. */
export type ClientFrame = Readonly<Record<string, unknown>> | ArrayBuffer;

/** Sends a frame; false: there is no connection. */
export type Send = (frame: ClientFrame) => boolean;

/** Read a binary frame; null: its opcode is not known. Throws RangeError when it is cut off. */
export function readBinary(frame: ArrayBuffer): ServerBinary | null {
  const view = new DataView(frame);
  switch (view.getUint8(0)) {
    case 1:
      return {
        op: "message",
        subscription: view.getUint32(1, true),
        time: view.getBigUint64(5, true),
        payload: new DataView(frame, 13),
      };
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
      return null;
  }
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
