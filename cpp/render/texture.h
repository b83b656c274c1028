// Texture coordinates of shapes, and texture sampling.
#pragma once

#include "intersect.h"
#include "kernel.h"
#include "simd.h"

namespace trundle::TRUNDLE_ISA {

// Texture coordinates, (0, 0) lower left, (1, 1) upper right; and their squared change per metre.
struct TextureUv {
  Floats u, v, squared_scale;
};

// atan2(y, x) / 2π in [0, 1], error 1e-5.
inline Floats angle_in_turns(Floats x, Floats y) {
  const Floats ax = abs(x), ay = abs(y);
  const Floats low = min(ax, ay), high = max(max(ax, ay), splat(1e-30f));
  const Floats t = low / high, q = t * t;
  Floats share = t * (0.1591336f + q * (-0.0525688f + q * (0.02867033f + q * (-0.01354934f + q * 0.00331601f))));
  share = select(ay > ax, 0.25f - share, share);
  share = select(x < 0.0f, 0.5f - share, share);
  return select(y < 0.0f, 1.0f - share, share);
}

inline Floats squared(float value) { return splat(value * value); }

// Box: once per face. Sphere, cylinder, capsule, ellipsoid: longitude and height. Plane: once; infinite: once per
// metre.
template <ShapeKind kind>
inline TextureUv uv_at(const Renderable& renderable, const Floats3& p, const Floats3& normal) {
  const float* size = renderable.size;
  if constexpr (kind == ShapeKind::kPlane) {
    const float x = size[0] > 0.0f ? 2.0f * size[0] : 1.0f, y = size[1] > 0.0f ? 2.0f * size[1] : 1.0f;
    return {p.x / x + 0.5f, p.y / y + 0.5f, squared(1.0f / (x < y ? x : y))};
  }
  if constexpr (kind == ShapeKind::kBox) {
    const Floats x = p.x / (2.0f * size[0]), y = p.y / (2.0f * size[1]), z = p.z / (2.0f * size[2]);
    const Ints is_x = normal.x != 0.0f, is_z = normal.z != 0.0f;
    const float smallest =
        size[0] < size[1] ? (size[0] < size[2] ? size[0] : size[2]) : (size[1] < size[2] ? size[1] : size[2]);
    const Floats along = select(is_x, select(normal.x > 0.0f, y, -y), select(normal.y > 0.0f, -x, x));
    return {select(is_z, x, along) + 0.5f, select(is_z, select(normal.z > 0.0f, y, -y), z) + 0.5f,
            squared(0.5f / smallest)};
  }
  const float height = kind == ShapeKind::kCylinder    ? size[1]
                       : kind == ShapeKind::kCapsule   ? size[1] + size[0]
                       : kind == ShapeKind::kEllipsoid ? size[2]
                                                       : size[0];
  const Floats volumes = angle_in_turns(p.x, p.y), up = p.z / (2.0f * height) + 0.5f;
  const Floats density = squared(0.5f / (height < size[0] ? height : size[0]));
  if constexpr (kind == ShapeKind::kCylinder) {
    const Ints cap = normal.z != 0.0f;
    const Floats x = p.x / (2.0f * size[0]) + 0.5f, y = p.y / (2.0f * size[0]) + 0.5f;
    return {select(cap, x, volumes), select(cap, y, up), density};
  }
  return {volumes, up, density};
}

inline TextureUv uv_of_face(const Triangles& mesh, const Floats3& p, Ints faces, Ints mask) {
  const Ints at = (faces & mask) * 8;
  Floats g[8];
  gather_four(mesh.uv_planes, at, g);
  gather_four(mesh.uv_planes + 4, at, g + 4);
  const Floats du = g[0] * g[0] + g[1] * g[1] + g[2] * g[2], dv = g[4] * g[4] + g[5] * g[5] + g[6] * g[6];
  return {g[0] * p.x + g[1] * p.y + g[2] * p.z + g[3], g[4] * p.x + g[5] * p.y + g[6] * p.z + g[7], max(du, dv)};
}

inline Floats channel(Ints texel, int shift) { return to_float((texel >> shift) & 255); }

// Bilinear sample on the mipmap level whose texels are about as large as the pixel's footprint, with its squared length
// in texture coordinates.
inline Floats3 sample_texture(const Texture& texture, const TextureUv& uv, Floats squared_footprint, Ints mask,
                              int& last_level) {
  const float across = static_cast<float>(texture.width[0] > texture.height[0] ? texture.width[0] : texture.height[0]);
  const Floats texels = max(min(squared_footprint * (across * across), splat(1e30f)), splat(1.0f));
  // round(log2(length)) = floor(log2(2 length²) / 2)
  const Ints level = min_of(((reinterpret_cast<Ints>(texels * 2.0f) >> 23) - 127) >> 1, texture.level_count - 1);
  Ints width, height, start;
  if (any(mask & (level != last_level))) {
    width = gather(texture.width, level);
    height = gather(texture.height, level);
    start = gather(texture.start, level);
    last_level = level[__builtin_ctz(bits(mask))];
  } else {
    width = splat(texture.width[last_level]);
    height = splat(texture.height[last_level]);
    start = splat(texture.start[last_level]);
  }
  // Wrapped before scaling, to keep precision far away; NaN becomes 0.
  Floats u = uv.u - floor(uv.u), v = uv.v - floor(uv.v);
  u = select((u >= 0.0f) & (u <= 1.0f), u, Floats{}) * to_float(width) - 0.5f;
  v = select((v >= 0.0f) & (v <= 1.0f), v, Floats{}) * to_float(height) - 0.5f;
  const Floats left = floor(u), low = floor(v), x = u - left, y = v - low;
  Ints column = to_int(left), row = to_int(low);  // -1 wraps to the last one
  column = select(column < 0, width - 1, column);
  row = select(row < 0, height - 1, row);
  const Ints here = start + row * (width + 1) + column;
  Ints a, b, c, d;
  gather_two(texture.texels, here, a, b);
  gather_two(texture.texels, here + width + 1, c, d);
  Floats value[3];
  for (int i = 0; i < 3; ++i) {
    const int shift = 8 * i;
    const Floats below = channel(a, shift) + x * (channel(b, shift) - channel(a, shift));
    const Floats over = channel(c, shift) + x * (channel(d, shift) - channel(c, shift));
    value[i] = (below + y * (over - below)) * (1.0f / 255.0f);
  }
  return {value[0], value[1], value[2]};
}

}  // namespace trundle::TRUNDLE_ISA
