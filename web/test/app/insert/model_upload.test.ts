/** The upload of a model. */

import { describe, expect, it } from "vitest";

import { ModelUpload, type UploadContext } from "../../../src/app/insert/model_upload";
import type { ModelFile } from "../../../src/app/insert/model_files";

describe("an upload", () => {
  it("that is cancelled while its folders are read is not sent", async () => {
    const upload = new ModelUpload({} as UploadContext, () => undefined);
    const files = [{ path: "wagon/model.sdf", file: new File(["<sdf/>"], "model.sdf") }];
    const sent = upload.send(new Promise<readonly ModelFile[]>((resolve) => setTimeout(() => resolve(files), 1)));
    upload.cancel();
    await sent;
    expect([upload.title.value, upload.fault.value]).toEqual([null, ""]); // to send it would fail: nothing listens
  });
});
