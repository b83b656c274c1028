// Where on its texture a surface is, and what the texture says there.
#pragma once

#include "intersect.h"
#include "kernel.h"
#include "lanes.h"

namespace trundle::TRUNDLE_ISA {

// Places in the texture, (0, 0) its lower left corner, (1, 1) its upper right; and how much of it a metre is, squared.
struct Layout {
  F u, v, squared_scale;
};

// The angle of (x, y) from +x, as a share of a turn, to 1e-5.
inline F turn_share(F x, F y) {
  const F ax = abs(x), ay = abs(y);
  const F low = min(ax, ay), high = max(max(ax, ay), splat(1e-30f));
  const F t = low / high, q = t * t;
  F share = t * (0.1591336f + q * (-0.0525688f + q * (0.02867033f + q * (-0.01354934f + q * 0.00331601f))));
  share = select(ay > ax, 0.25f - share, share);
  share = select(x < 0.0f, 0.5f - share, share);
  return select(y < 0.0f, 1.0f - share, share);
}

inline F squared(float value) { return splat(value * value); }

// Once over each face of a box, around and over balls and cylinders, once over a plane of known size and once a metre
// over an endless one.
template <Kind kind>
inline Layout layout_at(const Solid& solid, const F3& p, const F3& normal) {
  const float* size = solid.size;
  if constexpr (kind == Kind::kPlane) {
    const float x = size[0] > 0.0f ? 2.0f * size[0] : 1.0f, y = size[1] > 0.0f ? 2.0f * size[1] : 1.0f;
    return {p.x / x + 0.5f, p.y / y + 0.5f, squared(1.0f / (x < y ? x : y))};
  }
  if constexpr (kind == Kind::kBox) {
    const F x = p.x / (2.0f * size[0]), y = p.y / (2.0f * size[1]), z = p.z / (2.0f * size[2]);
    const I is_x = normal.x != 0.0f, is_z = normal.z != 0.0f;
    const float least = size[0] < size[1] ? (size[0] < size[2] ? size[0] : size[2])
                                          : (size[1] < size[2] ? size[1] : size[2]);
    const F along = select(is_x, select(normal.x > 0.0f, y, -y), select(normal.y > 0.0f, -x, x));
    return {select(is_z, x, along) + 0.5f, select(is_z, select(normal.z > 0.0f, y, -y), z) + 0.5f,
            squared(0.5f / least)};
  }
  const float height = kind == Kind::kCylinder ? size[1] : kind == Kind::kCapsule ? size[1] + size[0]
                       : kind == Kind::kEllipsoid ? size[2] : size[0];
  const F around = turn_share(p.x, p.y), up = p.z / (2.0f * height) + 0.5f;
  const F density = squared(0.5f / (height < size[0] ? height : size[0]));
  if constexpr (kind == Kind::kCylinder) {
    const I cap = normal.z != 0.0f;
    const F x = p.x / (2.0f * size[0]) + 0.5f, y = p.y / (2.0f * size[0]) + 0.5f;
    return {select(cap, x, around), select(cap, y, up), density};
  }
  return {around, up, density};
}

inline Layout layout_of_face(const Triangles& mesh, const F3& p, I faces, I mask) {
  const I at = (faces & mask) * 8;
  F g[8];
  gather_four(mesh.layout, at, g), gather_four(mesh.layout + 4, at, g + 4);
  const F du = g[0] * g[0] + g[1] * g[1] + g[2] * g[2], dv = g[4] * g[4] + g[5] * g[5] + g[6] * g[6];
  return {g[0] * p.x + g[1] * p.y + g[2] * p.z + g[3], g[4] * p.x + g[5] * p.y + g[6] * p.z + g[7], max(du, dv)};
}

inline F channel(I texel, int shift) { return to_float((texel >> shift) & 255); }

// The four texels around each place, on the level whose texels are about as large as what a pixel covers: the square of
// its length is given, in shares of the texture.
inline F3 texel_at(const Texture& texture, const Layout& layout, F squared_footprint, I mask, int& usual_level) {
  const float across = (float)(texture.width[0] > texture.height[0] ? texture.width[0] : texture.height[0]);
  const F texels = max(min(squared_footprint * (across * across), splat(1e30f)), splat(1.0f));
  // The level is the binary logarithm of the length, rounded: half of that of twice its square, rounded down.
  const I level = min_of((((I)(texels * 2.0f) >> 23) - 127) >> 1, texture.level_count - 1);
  I width, height, start;
  if (any(mask & (level != usual_level))) {
    width = gather(texture.width, level), height = gather(texture.height, level), start = gather(texture.start, level);
    usual_level = level[__builtin_ctz(bits(mask))];
  } else {
    width = splat(texture.width[usual_level]), height = splat(texture.height[usual_level]);
    start = splat(texture.start[usual_level]);
  }
  // Repeated before it is multiplied, so that far places stay exact; what is no number becomes 0.
  F u = layout.u - floor(layout.u), v = layout.v - floor(layout.v);
  u = select((u >= 0.0f) & (u <= 1.0f), u, F{}) * to_float(width) - 0.5f;
  v = select((v >= 0.0f) & (v <= 1.0f), v, F{}) * to_float(height) - 0.5f;
  const F left = floor(u), low = floor(v), x = u - left, y = v - low;
  I column = to_int(left), row = to_int(low);  // from -1, which is the last one, on
  column = select(column < 0, width - 1, column), row = select(row < 0, height - 1, row);
  const I here = start + row * (width + 1) + column;
  I a, b, c, d;
  gather_two(texture.texels, here, a, b), gather_two(texture.texels, here + width + 1, c, d);
  F value[3];
  for (int i = 0; i < 3; ++i) {
    const int shift = 8 * i;
    const F below = channel(a, shift) + x * (channel(b, shift) - channel(a, shift));
    const F over = channel(c, shift) + x * (channel(d, shift) - channel(c, shift));
    value[i] = (below + y * (over - below)) * (1.0f / 255.0f);
  }
  return {value[0], value[1], value[2]};
}

}  // namespace trundle::TRUNDLE_ISA
