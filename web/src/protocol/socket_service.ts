/** The worker's side of the page's socket: opens the socket, and passes frames on in both directions. */

export type SocketRequest =
  | { readonly kind: "open"; readonly socket: number; readonly url: string; readonly protocols: readonly string[] }
  | { readonly kind: "send"; readonly socket: number; readonly frame: string | ArrayBuffer }
  | { readonly kind: "close"; readonly socket: number };

/** Event of a socket: a received frame; without a frame, the socket was closed. */
export interface SocketEvent {
  readonly socket: number;
  readonly frame: string | ArrayBuffer | null;
}

export class SocketService {
  /** Open sockets by their number. */
  readonly #sockets = new Map<number, WebSocket>();

  constructor(
    private readonly emit: (event: SocketEvent, buffers: ArrayBuffer[]) => void,
    private readonly create = (url: string, protocols: readonly string[]) => new WebSocket(url, [...protocols]),
  ) {}

  handle(request: SocketRequest): void {
    const { socket: number } = request;
    if (request.kind === "open") this.#open(number, this.create(request.url, request.protocols));
    else if (request.kind === "send") this.#sockets.get(number)?.send(request.frame);
    else this.#sockets.get(number)?.close();
  }

  #open(number: number, socket: WebSocket): void {
    this.#sockets.set(number, socket);
    socket.binaryType = "arraybuffer";
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) =>
      this.emit({ socket: number, frame: data }, data instanceof ArrayBuffer ? [data] : []);
    socket.onclose = () => {
      this.#sockets.delete(number);
      this.emit({ socket: number, frame: null }, []);
    };
  }
}
