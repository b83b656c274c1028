import { expect, test } from "vitest";

import { SocketService, type SocketEvent, type SocketRequest } from "../../src/protocol/socket_service";
import { WorkerSockets } from "../../src/protocol/worker_sockets";

/** A socket in the worker. */
class FakeWebSocket {
  binaryType = "blob";
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onclose: (() => void) | null = null;
  readonly sent: unknown[] = [];
  constructor(
    readonly url: string,
    readonly protocols: readonly string[],
  ) {}
  send(frame: unknown): void {
    this.sent.push(frame);
  }
  close(): void {
    this.onclose?.();
  }
}

/** Sockets over a worker, whose messages arrive at once. */
function joined(): { readonly sockets: WorkerSockets; readonly opened: FakeWebSocket[] } {
  const opened: FakeWebSocket[] = [];
  const port: {
    onmessage: ((event: MessageEvent<SocketEvent>) => void) | null;
    postMessage: (request: SocketRequest) => void;
  } = { onmessage: null, postMessage: (request) => service.handle(request) };
  const service = new SocketService(
    (data) => port.onmessage?.(new MessageEvent("message", { data })),
    (url, protocols) => {
      opened.push(new FakeWebSocket(url, protocols));
      return opened.at(-1) as unknown as WebSocket;
    },
  );
  return { sockets: new WorkerSockets(port), opened };
}

test("what the worker's socket receives arrives, and what is sent goes out", () => {
  const { sockets, opened } = joined();
  const socket = sockets.open("ws://a/", ["p"]);
  const received: unknown[] = [];
  socket.onmessage = ({ data }) => received.push(data);

  const bytes = new Uint8Array([1, 2]).buffer;
  opened[0]?.onmessage?.({ data: "text" });
  opened[0]?.onmessage?.({ data: bytes });
  socket.send("question");

  expect(opened[0]).toMatchObject({ url: "ws://a/", protocols: ["p"], binaryType: "arraybuffer", sent: ["question"] });
  expect(received).toEqual(["text", bytes]);
});

test("a closed socket is told once, and the next one is its own", () => {
  const { sockets, opened } = joined();
  const closed: number[] = [];
  [1, 2].forEach((number) => {
    sockets.open("ws://a/", []).onclose = () => closed.push(number);
  });
  opened[0]?.close();
  sockets.open("ws://a/", []).onclose = () => closed.push(3);
  opened[2]?.onclose?.();

  expect(closed).toEqual([1, 3]);
});
