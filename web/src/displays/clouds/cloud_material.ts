/** Shaders of rviz's styles of points. They write a color's sRGB numbers unchanged, as all shaders of the scene do. */

import { DoubleSide, ShaderMaterial, Vector2, Vector3, Vector4 } from "three";

import { RAINBOW } from "./cloud_colors";

/** Styles of rviz's clouds; Tiles is the style of GridCells. */
export const STYLES = ["Points", "Squares", "Flat Squares", "Spheres", "Boxes"] as const;
export type Style = (typeof STYLES)[number] | "Tiles";

const VERTEX = /* glsl */ `
#define SQUARE_ROOT_2 1.41421356
#include <common>
#include <logdepthbuf_pars_vertex>
attribute uint px;
attribute uint py;
attribute uint pz;
attribute uint c0;
attribute uint c1;
attribute uint c2;
uniform vec3 pointSize;
uniform float autoSize;
uniform vec2 viewport;
uniform float pixelRatio;
uniform int colorMode;
uniform int channelType;
uniform int channelShift;
uniform vec4 axisRow;
uniform float low;
uniform float range;
uniform bool rainbow;
uniform bool invert;
uniform vec3 minColor;
uniform vec3 maxColor;
uniform vec3 knots[6];
varying vec4 vColor;
#ifdef SPRITE
varying vec2 vUp;
#else
varying vec2 vCorner;
#endif

bool isBad(uint bits) { return (bits & 0x7f800000u) == 0x7f800000u; }

float channelValue() {
  if (channelType == 7) return uintBitsToFloat(c0);
  if (channelType == 8) { // float64, to the precision of a float32
    uint biased = (c1 >> 20u) & 0x7ffu;
    if (biased < 897u) return 0.0;
    if (biased > 1150u) return uintBitsToFloat((c1 & 0x80000000u) | 0x7f7fffffu);
    return uintBitsToFloat((c1 & 0x80000000u) | ((biased - 896u) << 23u) | ((c1 & 0xfffffu) << 3u) | (c0 >> 29u));
  }
  uint mask = channelType <= 2 ? 0xffu : channelType <= 4 ? 0xffffu : 0xffffffffu;
  return float((c0 >> uint(channelShift)) & mask);
}

vec3 rainbowColor(float value) {
  float at = clamp(value, 0.0, 1.0) * 5.0;
  int knot = min(int(at), 4);
  return mix(knots[knot], knots[knot + 1], at - float(knot));
}

vec4 packedColor() {
  return vec4(float((c0 >> 16u) & 0xffu), float((c0 >> 8u) & 0xffu), float(c0 & 0xffu), float(c0 >> 24u)) / 255.0;
}

vec4 pointColor(vec3 point) {
  if (colorMode == 0) return vec4(minColor, 1.0);
  if (colorMode == 1) {
    float share = (channelValue() - low) / range;
    if (rainbow) return vec4(rainbowColor(invert ? share : 1.0 - share), 1.0);
    return vec4(mix(minColor, maxColor, clamp(share, 0.0, 1.0)), 1.0);
  }
  if (colorMode == 2) return vec4(rainbowColor(1.0 - (dot(axisRow, vec4(point, 1.0)) - low) / range), 1.0);
  if (colorMode == 3) return vec4(uintBitsToFloat(c0), uintBitsToFloat(c1), uintBitsToFloat(c2), 1.0);
  vec4 color = packedColor();
  if (colorMode == 5) color.rgb = vec3(dot(color.rgb, vec3(0.2989, 0.5870, 0.1140)));
  return invert ? color : vec4(color.rgb, 1.0); // invert: the channel has an alpha of its own
}

void main() {
  vec3 point = vec3(uintBitsToFloat(px), uintBitsToFloat(py), uintBitsToFloat(pz));
  if (isBad(px) || isBad(py) || isBad(pz)) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0); // outside of the view
    #ifdef SPRITE
    gl_PointSize = 1.0;
    #endif
    return;
  }
  vColor = pointColor(point);
  vec3 size = pointSize * (1.0 - autoSize + autoSize * point.z);
  #ifndef SPRITE
  vCorner = uv;
  #endif
  #if STYLE == 4
  vColor.rgb *= normal.x; // lightness of the box's side
  #endif
  #if STYLE >= 4
  vec4 mvPosition = modelViewMatrix * vec4(point + position * size, 1.0);
  #else
  vec4 mvPosition = modelViewMatrix * vec4(point, 1.0);
  #endif
  #if STYLE > 0 && STYLE < 4
  // squares face the eye with an edge along the frame's y axis, as rviz's without geometry shaders
  vec3 back = isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(-mvPosition.xyz);
  vec3 up = normalize(modelViewMatrix[1].xyz - back * dot(modelViewMatrix[1].xyz, back));
  #ifdef SPRITE
  vUp = normalize(up.xy);
  #else
  mvPosition.xyz += (cross(up, back) * position.x + up * position.y) * size.x;
  #endif
  #endif
  gl_Position = projectionMatrix * mvPosition;
  #ifdef SPRITE
    #if STYLE == 0
    gl_PointSize = pointSize.x * pixelRatio;
    #else
    gl_PointSize = size.x * projectionMatrix[1][1] * viewport.y * 0.5 / gl_Position.w;
    #if STYLE < 3
    gl_PointSize *= SQUARE_ROOT_2; // the square is turned within it
    #endif
    #endif
  #elif STYLE == 0
  gl_Position.xy += position.xy * pointSize.x * pixelRatio * 2.0 / viewport * gl_Position.w;
  #endif
  #include <logdepthbuf_vertex>
}`;

const FRAGMENT = /* glsl */ `
#define SQUARE_ROOT_2 1.41421356
#include <common>
#include <logdepthbuf_pars_fragment>
uniform float alpha;
varying vec4 vColor;
#ifdef SPRITE
varying vec2 vUp;
#else
varying vec2 vCorner;
#endif

void main() {
  #include <logdepthbuf_fragment>
  #ifdef SPRITE
  vec2 vCorner = vec2(gl_PointCoord.x - 0.5, 0.5 - gl_PointCoord.y);
  #if STYLE == 1 || STYLE == 2
  vCorner = SQUARE_ROOT_2 * vec2(dot(vCorner, vec2(vUp.y, -vUp.x)), dot(vCorner, vUp));
  if (max(abs(vCorner.x), abs(vCorner.y)) > 0.5) discard;
  #endif
  #endif
  vec3 color = vColor.rgb;
  #if STYLE == 0
  if (dot(vCorner, vCorner) >= 0.25) discard;
  #elif STYLE == 3
  float shade = (0.25 - dot(vCorner, vCorner)) * 4.0;
  if (shade <= 0.0) discard;
  color = mix(0.8 * color, color, shade);
  #elif STYLE != 2
  vec2 inside = smoothstep(-0.48, -0.45, vCorner) * (1.0 - smoothstep(0.45, 0.48, vCorner));
  float edge = 1.0 - inside.x * inside.y;
  #if STYLE == 4
  color *= 1.0 - 0.5 * edge;
  #else
  color += sign(0.5 - length(color)) * 0.2 * edge; // lighter or darker edges
  #endif
  #endif
  if (alpha * vColor.a < 1.0 / 255.0) discard;
  gl_FragColor = vec4(color, alpha * vColor.a);
}`;

/** Ways to color a point; numbers are the shader's. */
export const ColorMode = { flat: 0, channel: 1, axis: 2, floats: 3, packed: 4, mono: 5 } as const;

export class CloudMaterial extends ShaderMaterial {
  override readonly uniforms = {
    pointSize: { value: new Vector3(0.01, 0.01, 0.01) },
    autoSize: { value: 0 },
    /** Size of the picture [device pixels]. */
    viewport: { value: new Vector2(1, 1) },
    pixelRatio: { value: 1 },
    alpha: { value: 1 },
    colorMode: { value: 0 as number },
    channelType: { value: 7 },
    channelShift: { value: 0 },
    axisRow: { value: new Vector4() },
    low: { value: 0 },
    range: { value: 1 },
    rainbow: { value: true },
    invert: { value: false },
    minColor: { value: new Vector3(1, 1, 1) },
    maxColor: { value: new Vector3(1, 1, 1) },
    knots: { value: RAINBOW.map((knot) => new Vector3(...knot)) },
  };

  /** Sprites are drawn as GL's points, other shapes as instances of a geometry. */
  constructor(
    readonly style: Style,
    isSprite: boolean,
  ) {
    super({ vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide });
    this.defines = { STYLE: style === "Tiles" ? 5 : STYLES.indexOf(style), ...(isSprite ? { SPRITE: "" } : {}) };
  }

  /** Opaque at 1, as rviz's 0.9998 has it; blended points write no depth. */
  setAlpha(alpha: number, isPerPoint: boolean): void {
    this.uniforms.alpha.value = alpha;
    this.transparent = alpha < 0.9998 || isPerPoint;
    this.depthWrite = !this.transparent;
  }
}
