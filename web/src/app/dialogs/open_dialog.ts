/** Dialog that is open; null: none. */
export type OpenDialog =
  | "palette"
  | "help"
  | "notices"
  | "save"
  | "save_world"
  | "save_model"
  | "picture"
  | "share"
  | "upload"
  | "time"
  | null;
