/** A model, a shape or a light that can be inserted into the running world. */

export type Insertable =
  | { readonly kind: "model"; readonly name: string; readonly title: string }
  | { readonly kind: "shape"; readonly name: "box" | "sphere" | "cylinder"; readonly title: string }
  | { readonly kind: "light"; readonly name: "point" | "directional" | "spot"; readonly title: string };
