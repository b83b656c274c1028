/** Worker that decodes messages. */

import { DecodeService, type DecodeRequest } from "./decode_service";

const service = new DecodeService((response, transfer) => self.postMessage(response, { transfer }));
self.onmessage = (event: MessageEvent<DecodeRequest>) => service.handle(event.data);
