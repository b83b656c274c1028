/** What can be put into a running world. */

export const SHAPES = ["box", "sphere", "cylinder"] as const;
export const LIGHTS = ["point", "directional", "spot"] as const;

export type Insertable =
  | { readonly kind: "model"; readonly name: string; readonly title: string }
  | { readonly kind: "shape"; readonly name: (typeof SHAPES)[number]; readonly title: string }
  | { readonly kind: "light"; readonly name: (typeof LIGHTS)[number]; readonly title: string };
