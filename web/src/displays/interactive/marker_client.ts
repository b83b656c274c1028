/** Interactive markers of the servers on a topic, by their protocol: a full state, then numbered updates. */

import type { Connection, Subscription } from "../../protocol/connection";
import type {
  InteractiveMarker,
  InteractiveMarkerInit,
  InteractiveMarkerPose,
  InteractiveMarkerUpdate,
} from "../../protocol/generated/ros_messages";

const KEEP_ALIVE = 0;
/** Seconds without a message after which a server is silent; servers say something twice a second. */
const SILENT_S = 2;

export interface ClientEvents {
  readonly put: (marker: InteractiveMarker) => void;
  readonly move: (pose: InteractiveMarkerPose) => void;
  readonly erase: (name: string) => void;
  /** A server's state, in rviz's words. */
  readonly status: (server: string, level: "ok" | "warn" | "error", text: string) => void;
}

interface Server {
  /** Number of the last update that is part of the state; null: no full state yet. */
  sequence: bigint | null;
  readonly names: Set<string>;
  silence: number;
}

export class MarkerClient {
  private readonly servers = new Map<string, Server>();
  private readonly inits = new Map<string, InteractiveMarkerInit>();
  private readonly subscriptions: readonly Subscription[];

  constructor(
    connection: Connection,
    full: string,
    updates: string,
    private readonly events: ClientEvents,
    onError: (text: string) => void,
  ) {
    const options = { every: true, onError };
    this.subscriptions = [
      connection.subscribe<InteractiveMarkerInit>(full, ({ message }) => this.init(message), options),
      connection.subscribe<InteractiveMarkerUpdate>(updates, ({ message }) => this.update(message), options),
    ];
  }

  close(): void {
    for (const subscription of this.subscriptions) subscription.close();
  }

  /** Advance by wall seconds. */
  tick(elapsed: number): void {
    for (const [name, server] of this.servers) {
      const wasAlive = server.silence < SILENT_S;
      server.silence += elapsed;
      if (wasAlive && server.silence >= SILENT_S) {
        this.events.status(name, "warn", `No update received for at least ${SILENT_S} seconds.`);
      }
    }
  }

  private server(name: string): Server {
    const server = this.servers.get(name) ?? { sequence: null, names: new Set<string>(), silence: 0 };
    this.servers.set(name, server);
    server.silence = 0;
    return server;
  }

  private init(message: InteractiveMarkerInit): void {
    this.inits.set(message.server_id, message);
    const server = this.server(message.server_id);
    if (server.sequence === null) this.begin(message.server_id, server, message);
  }

  private begin(name: string, server: Server, message: InteractiveMarkerInit): void {
    for (const old of server.names) this.events.erase(old);
    server.names.clear();
    server.sequence = message.seq_num;
    for (const marker of message.markers) {
      server.names.add(marker.name);
      this.events.put(marker);
    }
    this.events.status(name, "ok", "OK");
  }

  private update(message: InteractiveMarkerUpdate): void {
    const { server_id: name, seq_num: sequence } = message;
    const server = this.server(name);
    if (server.sequence === null) this.events.status(name, "warn", "Waiting for init message.");
    else if (message.type === KEEP_ALIVE) this.keepAlive(name, server, sequence);
    else if (sequence === server.sequence + 1n) this.apply(name, server, message);
    else if (sequence > server.sequence) this.resync(name, server, sequence);
  }

  private keepAlive(name: string, server: Server, sequence: bigint): void {
    if (sequence === server.sequence) this.events.status(name, "ok", "OK");
    else this.resync(name, server, sequence);
  }

  private apply(name: string, server: Server, message: InteractiveMarkerUpdate): void {
    server.sequence = message.seq_num;
    for (const marker of message.markers) {
      server.names.add(marker.name);
      this.events.put(marker);
    }
    for (const pose of message.poses) this.events.move(pose);
    for (const erased of message.erases) {
      server.names.delete(erased);
      this.events.erase(erased);
    }
    this.events.status(name, "ok", "OK");
  }

  /** Start again after a missing update or a restarted server; its full state comes with every change. */
  private resync(name: string, server: Server, sequence: bigint): void {
    const init = this.inits.get(name);
    if (init !== undefined && init.seq_num >= sequence) this.begin(name, server, init);
    else {
      server.sequence = null;
      this.events.status(name, "warn", "Received non-consecutive update; waiting for init message.");
    }
  }
}
