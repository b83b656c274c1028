/** Topics that the page publishes. */

import type { RosMessage } from "./ros_types";
import { parseSchema, type Schema } from "./schema";
import { messageFrame, type Send } from "./wire";
import { writeMessage } from "./writer";

export class Publications {
  /** Channels of this connection, by topic and type with a space between. */
  readonly #channels = new Map<string, number>();
  readonly #schemas = new Map<string, Promise<Schema>>();
  #nextChannel = 1;

  constructor(
    private readonly send: Send,
    /** Text of a type's definition. */
    private readonly definition: (type: string) => Promise<string>,
  ) {}

  /** Begin again with a server without publications. */
  restart(): void {
    this.#channels.clear();
  }

  /** Publish a message; rejects with a sentence if the message does not fit its type, or the type is unknown. */
  async publish(topic: string, type: string, message: RosMessage): Promise<void> {
    const payload = writeMessage(await this.#schema(type), message);
    if (!this.send(messageFrame(this.#channel(topic, type), payload))) throw new Error("the page is not connected");
  }

  #schema(type: string): Promise<Schema> {
    const known = this.#schemas.get(type);
    if (known !== undefined) return known;
    const schema = this.definition(type).then((text) => parseSchema(type, text));
    this.#schemas.set(type, schema);
    schema.catch(() => this.#schemas.delete(type));
    return schema;
  }

  #channel(topic: string, type: string): number {
    const key = `${topic} ${type}`;
    const known = this.#channels.get(key);
    if (known !== undefined) return known;
    const id = this.#nextChannel++;
    const channel = { id, topic, encoding: "ros1", schemaName: type };
    if (this.send({ op: "advertise", channels: [channel] })) this.#channels.set(key, id);
    return id;
  }
}
