/** Layout of `trundle/contacts`: both bodies, position, force and depth of each contact, as float64. */

export const HEADER = 16;
export const SIZE = 72;
/** Largest number of contacts that the server sends. */
export const MAX_CONTACTS = 2000;

/** Number of contacts in a message; 0 if the message belongs to another generation of the world. */
export function contactCount(message: DataView, generation: number | undefined): number {
  if (message.byteLength < HEADER || message.getUint32(8, true) !== generation) return 0;
  return Math.min(MAX_CONTACTS, message.getUint32(12, true), Math.floor((message.byteLength - HEADER) / SIZE));
}
