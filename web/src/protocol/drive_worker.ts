/** Worker that drives: its socket and its timer wait neither for the page nor for the page's data. */

import { DRIVE_SUBPROTOCOL, DriveService, type DriveRequest } from "./drive_service";

let service: DriveService | null = null;
self.onmessage = ({ data: request }: MessageEvent<DriveRequest>) => {
  if (request.kind !== "open") service?.handle(request);
  else
    service = new DriveService(
      () => new WebSocket(request.url, [DRIVE_SUBPROTOCOL]),
      (report) => self.postMessage(report),
    );
};
