/**
 * Shader of SDF materials: Blinn–Phong as Trundle's own renderer shades (cpp/render/shade.h), with its lights, its shadows of
 * four texels and its fog.
 */

export const VERTEX_SHADER = /* glsl */ `
varying vec3 point;
varying vec3 outward;
varying float depth;
#ifdef TEXTURED
uniform mat3 uvTransform;
varying vec2 at;
#endif
#include <skinning_pars_vertex>
void main() {
  vec3 transformed = position;
  vec3 objectNormal = normal;
  #include <skinbase_vertex>
  #include <skinnormal_vertex>
  #include <skinning_vertex>
  vec4 world = modelMatrix * vec4(transformed, 1.0);
  vec4 inView = viewMatrix * world;
  point = world.xyz;
  depth = -inView.z;
  outward = transpose(mat3(viewMatrix)) * (normalMatrix * objectNormal);
#ifdef TEXTURED
  at = (uvTransform * vec3(uv, 1.0)).xy;
#endif
  gl_Position = projectionMatrix * inView;
}`;

export type LightKind = "directional" | "point" | "spot";
export const FOG_KINDS: Readonly<Record<string, number>> = { none: 0, linear: 1, exponential: 2, quadratic: 3 };

const HEAD = /* glsl */ `
precision highp sampler2DShadow;
varying vec3 point;
varying vec3 outward;
varying float depth;
uniform vec3 ambientLight;
uniform vec3 ambient;
uniform vec4 diffuse;
uniform vec3 specular;
uniform vec3 emissive;
uniform float shininess;
#ifdef TEXTURED
uniform sampler2D image;
varying vec2 at;
#endif
struct Fog { int kind; vec3 color; float start; float end; float density; };
uniform Fog fogOfWorld;
#if LIGHTS > 0
struct Light {
  vec3 position; vec3 toLight; vec3 diffuse; vec3 specular; vec3 attenuation;
  float range; float cosInner; float cosOuter; float falloff;
};
uniform Light lights[LIGHTS];
#endif
#if SHADOWS > 0
struct Shadow { mat4 view; mat4 projection; float texel; bool isActive; };
uniform Shadow shadows[SHADOWS];
#endif
`;

const FOG = /* glsl */ `
float transmittance() {
  if (fogOfWorld.kind == 1) return clamp((fogOfWorld.end - depth) / (fogOfWorld.end - fogOfWorld.start), 0.0, 1.0);
  float thick = depth * fogOfWorld.density;
  return exp(fogOfWorld.kind == 2 ? -thick : -thick * thick);
}
`;

/** Ratio of a light that is not shadowed: lookups in its map, four texels each. */
function shadowFactor(light: number, kind: LightKind): string {
  const shadow = `shadows[${light}]`;
  return `
uniform sampler2DShadow shadowMap${light};
float shadowFactor${light}(vec3 n, float facing) {
  if (!${shadow}.isActive) return 1.0;
  vec4 p = ${shadow}.view * vec4(point, 1.0);
  float texel = ${kind === "directional" ? `${shadow}.texel` : `abs(p.z) * ${shadow}.texel`};
  p.xyz += mat3(${shadow}.view) * n * (1.5 * texel);
  ${kind === "directional" ? "" : "if (p.z > -0.01) return 1.0;"}
  float slope = sqrt(max(1.0 - facing * facing, 0.0)) / max(facing, 1e-3);
  p.z += 0.5 * texel * (1.0 + min(slope, 8.0));
  vec4 q = ${shadow}.projection * p;
  vec3 lookup = 0.5 * q.xyz / q.w + 0.5;
  if (any(lessThan(lookup, vec3(0.0))) || any(greaterThan(lookup, vec3(1.0)))) return 1.0;
  return texture(shadowMap${light}, lookup);
}`;
}

/** Strength at the point without shadow, and the direction to the light. */
function strength(light: string, kind: LightKind): string {
  if (kind === "directional") return `toLight = ${light}.toLight; strength = 1.0;`;
  const cone = `share = clamp((dot(toLight, ${light}.toLight) - ${light}.cosOuter) / (${light}.cosInner - ${light}.cosOuter), 0.0, 1.0);
  strength *= share > 0.0 ? pow(share, ${light}.falloff) : 0.0;`;
  return `
  toLight = ${light}.position - point;
  distance = length(toLight);
  toLight /= max(distance, 1e-6);
  strength = 1.0 / max(${light}.attenuation.x + distance * (${light}.attenuation.y + distance * ${light}.attenuation.z), 1e-3);
  if (distance > ${light}.range) strength = 0.0;
  ${kind === "spot" ? cone : ""}`;
}

/** Shading of one light, with its fields' names written out, since the CPU would copy a structure at each pixel. */
function shading(index: number, kind: LightKind, hasShadow: boolean): string {
  const light = `lights[${index}]`;
  return `
  ${strength(light, kind)}
  facing = max(dot(n, toLight), 0.0);
  if (strength > 0.0 && facing > 0.0) {
    ${hasShadow ? `strength *= shadowFactor${index}(n, facing);` : ""}
    sumDiffuse += ${light}.diffuse * (facing * strength);
    if (isGlossy) {
      halfway = toLight + toEye;
      gloss = pow(max(dot(n, halfway), 0.0) / sqrt(max(dot(halfway, halfway), 1e-12)), max(shininess, 1e-3));
      sumSpecular += ${light}.specular * (gloss * strength);
    }
  }`;
}

/** Fragment shader for some lights, of which the first ones have shadow maps. */
export function fragmentShader(lights: readonly LightKind[], shadows: number): string {
  return `
#define LIGHTS ${lights.length}
#define SHADOWS ${shadows}
${HEAD}${FOG}${lights
  .slice(0, shadows)
  .map((kind, i) => shadowFactor(i, kind))
  .join("\n")}
void main() {
#ifdef FLAT
  vec3 n = normalize(cross(dFdx(point), dFdy(point)));
#else
  vec3 n = normalize(outward);
#endif
  vec3 toEye = isOrthographic ? vec3(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2]) : normalize(cameraPosition - point);
  vec3 sumDiffuse = vec3(0.0), sumSpecular = vec3(0.0), toLight, halfway;
  float strength, facing, distance, share, gloss;
  bool isGlossy = any(greaterThan(specular, vec3(0.0)));
${lights.map((kind, i) => shading(i, kind, i < shadows)).join("")}
  vec3 color = min(ambientLight * ambient + sumDiffuse * diffuse.rgb + emissive, vec3(1.0));
#ifdef TEXTURED
  color *= texture2D(image, at).rgb;
#endif
  color += min(sumSpecular * specular, vec3(1.0));
  if (fogOfWorld.kind != 0) color = mix(fogOfWorld.color, color, transmittance());
  gl_FragColor = vec4(clamp(color, 0.0, 1.0), diffuse.a);
}`;
}
