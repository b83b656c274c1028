/** Entry of a bundle whose packages are those of its worker. */

export const worker = new Worker(new URL("../../src/protocol/decode_worker.ts", import.meta.url), { type: "module" });
