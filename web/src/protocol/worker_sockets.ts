/** Sockets that a worker holds, with the interface of a socket of this thread. */

import type { Socket } from "./reconnecting_socket";
import type { SocketEvent, SocketRequest } from "./socket_service";

/** Part of Worker that is used. */
export interface SocketPort {
  onmessage: ((event: MessageEvent<SocketEvent>) => void) | null;
  postMessage(request: SocketRequest): void;
}

export class WorkerSockets {
  /** Open sockets by their number. */
  readonly #sockets = new Map<number, Socket>();
  #next = 0;

  constructor(private readonly port: SocketPort) {
    port.onmessage = ({ data: { socket: number, frame } }) => {
      const socket = this.#sockets.get(number);
      if (frame === null) {
        this.#sockets.delete(number);
        socket?.onclose?.call(null as never, new CloseEvent("close"));
      } else socket?.onmessage?.call(null as never, new MessageEvent("message", { data: frame }));
    };
  }

  open(url: string, protocols: readonly string[]): Socket {
    const number = this.#next++;
    const send = (frame: string | ArrayBuffer): void => this.port.postMessage({ kind: "send", socket: number, frame });
    const close = (): void => this.port.postMessage({ kind: "close", socket: number });
    const socket: Socket = { send, close, onopen: null, onmessage: null, onclose: null };
    this.#sockets.set(number, socket);
    this.port.postMessage({ kind: "open", socket: number, url, protocols });
    return socket;
  }
}
