/**
 * Shader of SDF materials: Blinn–Phong as Trundle's own renderer shades (cpp/shade.h), with its lights, its shadows of
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
  vec4 seen = viewMatrix * world;
  point = world.xyz;
  depth = -seen.z;
  outward = transpose(mat3(viewMatrix)) * (normalMatrix * objectNormal);
#ifdef TEXTURED
  at = (uvTransform * vec3(uv, 1.0)).xy;
#endif
  gl_Position = projectionMatrix * seen;
}`;

/** Kinds of lights as the shader numbers them. */
export const LIGHT_KINDS = { directional: 0, point: 1, spot: 2 } as const;
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
  int kind; vec3 position; vec3 toLight; vec3 diffuse; vec3 specular; vec3 attenuation;
  float range; float cosInner; float cosOuter; float falloff;
};
uniform Light lights[LIGHTS];
#endif
#if SHADOWS > 0
struct Shadow { mat4 view; mat4 projection; float texel; bool isOrthographic; bool isThere; };
uniform Shadow shadows[SHADOWS];
float shadowFactor(Shadow shadow, sampler2DShadow map, vec3 n, float facing) {
  if (!shadow.isThere) return 1.0;
  vec4 p = shadow.view * vec4(point, 1.0);
  float texel = shadow.isOrthographic ? shadow.texel : abs(p.z) * shadow.texel;
  p.xyz += mat3(shadow.view) * n * (1.5 * texel);
  if (!shadow.isOrthographic && p.z > -0.01) return 1.0;
  float slope = sqrt(max(1.0 - facing * facing, 0.0)) / max(facing, 1e-3);
  p.z += 0.5 * texel * (1.0 + min(slope, 8.0));
  vec4 q = shadow.projection * p;
  vec3 lookup = 0.5 * q.xyz / q.w + 0.5;
  if (any(lessThan(lookup, vec3(0.0))) || any(greaterThan(lookup, vec3(1.0)))) return 1.0;
  return texture(map, lookup);
}
#endif
`;

const BODY = /* glsl */ `
void addLight(Light light, float share, vec3 n, vec3 toEye, vec3 toLight, float facing, inout vec3 sumDiffuse, inout vec3 sumSpecular) {
  sumDiffuse += light.diffuse * (facing * share);
  vec3 halfway = toLight + toEye;
  float gloss = pow(max(dot(n, halfway), 0.0) / sqrt(max(dot(halfway, halfway), 1e-12)), max(shininess, 1e-3));
  sumSpecular += light.specular * (gloss * share);
}
/** Strength at the point without shadow; the direction to the light goes to toLight. */
float strengthOf(Light light, out vec3 toLight) {
  toLight = light.toLight;
  if (light.kind == 0) return 1.0;
  vec3 way = light.position - point;
  float distance = length(way);
  toLight = way / max(distance, 1e-6);
  if (distance > light.range) return 0.0;
  float strength = 1.0 / max(light.attenuation.x + distance * (light.attenuation.y + distance * light.attenuation.z), 1e-3);
  if (light.kind == 1) return strength;
  float share = clamp((dot(toLight, light.toLight) - light.cosOuter) / (light.cosInner - light.cosOuter), 0.0, 1.0);
  return share > 0.0 ? strength * pow(share, light.falloff) : 0.0;
}
`;

const FOG = /* glsl */ `
float transmittance() {
  if (fogOfWorld.kind == 1) return clamp((fogOfWorld.end - depth) / (fogOfWorld.end - fogOfWorld.start), 0.0, 1.0);
  float thick = depth * fogOfWorld.density;
  return exp(fogOfWorld.kind == 2 ? -thick : -thick * thick);
}
`;

/** Fragment shader for some lights, of which the first ones have shadow maps. */
export function fragmentShader(lights: number, shadows: number): string {
  const maps = Array.from({ length: shadows }, (_, i) => `uniform sampler2DShadow shadowMap${i};\n`).join("");
  const each = Array.from({ length: lights }, (_, i) => {
    const shadow = i < shadows ? `strength *= shadowFactor(shadows[${i}], shadowMap${i}, n, facing);` : "";
    return `
  strength = strengthOf(lights[${i}], toLight);
  facing = max(dot(n, toLight), 0.0);
  if (strength > 0.0 && facing > 0.0) {
    ${shadow}
    addLight(lights[${i}], strength, n, toEye, toLight, facing, sumDiffuse, sumSpecular);
  }`;
  }).join("");
  return `
#define LIGHTS ${lights}
#define SHADOWS ${shadows}
${HEAD}${maps}${lights > 0 ? BODY : ""}${FOG}
void main() {
#ifdef FLAT
  vec3 n = normalize(cross(dFdx(point), dFdy(point)));
#else
  vec3 n = normalize(outward);
#endif
  vec3 toEye = isOrthographic ? vec3(viewMatrix[0][2], viewMatrix[1][2], viewMatrix[2][2]) : normalize(cameraPosition - point);
  vec3 sumDiffuse = vec3(0.0), sumSpecular = vec3(0.0), toLight;
  float strength, facing;
${each}
  vec3 colour = min(ambientLight * ambient + sumDiffuse * diffuse.rgb + emissive, vec3(1.0));
#ifdef TEXTURED
  colour *= texture2D(image, at).rgb;
#endif
  colour += min(sumSpecular * specular, vec3(1.0));
  if (fogOfWorld.kind != 0) colour = mix(fogOfWorld.color, colour, transmittance());
  gl_FragColor = vec4(clamp(colour, 0.0, 1.0), diffuse.a);
}`;
}
