/** The worker's side of decoding. */

import { readMessage } from "./reader";
import type { RosMessage } from "./ros_types";
import { parseSchema, type Schema } from "./schema";

export type DecodeRequest =
  | { readonly kind: "open"; readonly channel: number; readonly name: string; readonly definition: string }
  | { readonly kind: "decode"; readonly channel: number; readonly payloads: readonly DataView[] }
  | { readonly kind: "close"; readonly channel: number };

/** Results of one "decode", in its order: messages, or error sentences. */
export interface DecodeResponse {
  readonly channel: number;
  readonly results: readonly (RosMessage | string)[];
}

export class DecodeService {
  /** Channel → its schema, or the error in its definition. */
  readonly #schemas = new Map<number, Schema | string>();

  constructor(private readonly respond: (response: DecodeResponse, buffers: ArrayBuffer[]) => void) {}

  handle(request: DecodeRequest): void {
    if (request.kind === "open") {
      this.#schemas.set(
        request.channel,
        attempt(() => parseSchema(request.name, request.definition)),
      );
    } else if (request.kind === "close") {
      this.#schemas.delete(request.channel);
    } else {
      const schema = this.#schemas.get(request.channel) ?? "its channel is closed";
      const buffers = new Set<ArrayBuffer>();
      const results = request.payloads.map((payload) =>
        typeof schema === "string" ? schema : attempt(() => readMessage(schema, payload, buffers)),
      );
      this.respond({ channel: request.channel, results }, [...buffers]);
    }
  }
}

/** Result of a function, or its error's sentence. */
function attempt<T>(work: () => T): T | string {
  try {
    return work();
  } catch (error) {
    return error instanceof Error ? error.message : String(error);
  }
}
