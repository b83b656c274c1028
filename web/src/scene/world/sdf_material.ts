/** Materials of the simulated world: colors of SDF, from `extras.sdf` of a GLB. */

import { Color, FrontSide, Matrix3, ShaderMaterial, Vector4, type Material, type Texture } from "three";

import { VERTEX_SHADER } from "./sdf_shader";
import type { WorldLighting } from "./world_lighting";

/** Sharpness of textures seen at a slant. */
const ANISOTROPY = 4;

type Rgba = readonly [number, number, number, number];

/** Colors as SDF has them, each component 0…1. */
export interface SdfColors {
  readonly ambient: Rgba;
  readonly diffuse: Rgba;
  readonly specular: Rgba;
  readonly emissive: Rgba;
  readonly shininess: number;
}

const GREY: Rgba = [0.7, 0.7, 0.7, 1];

/** Colors of a GLB's material; for materials without `extras.sdf`, the base color. */
export function sdfColors(material: Material): SdfColors {
  const stored = material.userData["sdf"] as Partial<SdfColors> | undefined;
  const base =
    "color" in material && material.color instanceof Color ? material.color.clone().convertLinearToSRGB() : null;
  const plain: Rgba = base === null ? GREY : [base.r, base.g, base.b, material.opacity];
  const { diffuse = plain, specular = [0, 0, 0, 1], emissive = [0, 0, 0, 1], shininess = 16 } = stored ?? {};
  return { ambient: stored?.ambient ?? diffuse, diffuse, specular, emissive, shininess };
}

/** Material of a visual; `isFlat`: its geometry has no normals. */
export function sdfMaterial(
  colors: SdfColors,
  texture: Texture | null,
  isFlat: boolean,
  lighting: WorldLighting,
): ShaderMaterial {
  const { ambient, diffuse, specular, emissive, shininess } = colors;
  const uniforms: ShaderMaterial["uniforms"] = {
    ambient: { value: new Color(...rgb(ambient)) },
    diffuse: { value: new Vector4(...diffuse) },
    specular: { value: new Color(...rgb(specular)) },
    emissive: { value: new Color(...rgb(emissive)) },
    shininess: { value: shininess },
  };
  const defines: Record<string, string> = {};
  if (isFlat) defines["FLAT"] = "";
  if (texture !== null) {
    defines["TEXTURED"] = "";
    texture.colorSpace = ""; // the shader uses the sRGB numbers unchanged
    texture.anisotropy = ANISOTROPY;
    texture.updateMatrix();
    uniforms["image"] = { value: texture };
    uniforms["uvTransform"] = { value: new Matrix3().copy(texture.matrix) };
  }
  const isTransparent = diffuse[3] < 1;
  const material = new ShaderMaterial({
    // behind displays' objects at the same place, such as the RobotModel of a simulated robot
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 32, // maps in the plane of the ground are drawn over it
    vertexShader: VERTEX_SHADER,
    fragmentShader: "",
    uniforms,
    defines,
    side: FrontSide,
    transparent: isTransparent,
    depthWrite: !isTransparent,
  });
  lighting.light(material);
  return material;
}

/** Ratio of a visual's opacity when it is drawn transparent, as in Gazebo. */
const OPACITY = 0.5;

/** Variant of a material: half transparent, or wireframe. */
export function sdfVariant(
  plain: ShaderMaterial,
  { transparent, wireframe }: { readonly transparent: boolean; readonly wireframe: boolean },
  lighting: WorldLighting,
): ShaderMaterial {
  const { uniforms, defines, vertexShader, side } = plain;
  const diffuse = (uniforms["diffuse"]?.value as Vector4).clone();
  if (transparent) diffuse.w *= OPACITY;
  const variantUniforms: ShaderMaterial["uniforms"] = { ...uniforms, diffuse: { value: diffuse } };
  const emissive = uniforms["emissive"]?.value as Color;
  if (wireframe)
    variantUniforms["emissive"] = { value: emissive.clone().add(new Color(diffuse.x, diffuse.y, diffuse.z)) }; // lines have no shading
  const isBlended = diffuse.w < 1;
  const { polygonOffset, polygonOffsetFactor, polygonOffsetUnits } = plain;
  const material = new ShaderMaterial({
    polygonOffset,
    polygonOffsetFactor,
    polygonOffsetUnits,
    vertexShader,
    side,
    fragmentShader: "",
    uniforms: variantUniforms,
    defines: { ...defines },
    wireframe,
    transparent: isBlended,
    depthWrite: !isBlended,
  });
  lighting.light(material);
  return material;
}

function rgb([red, green, blue]: Rgba): [number, number, number] {
  return [red, green, blue];
}
