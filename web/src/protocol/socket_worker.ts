/** Worker that holds the page's socket: a browser stops receiving while the socket's thread is busy drawing. */

import { SocketService, type SocketRequest } from "./socket_service";

const service = new SocketService((event, transfer) => self.postMessage(event, { transfer }));
self.onmessage = (event: MessageEvent<SocketRequest>) => service.handle(event.data);
