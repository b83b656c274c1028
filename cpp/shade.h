// Light on what is seen: Lambert's law for each light, over the ambient light.
#pragma once

#include "kernel.h"
#include "lanes.h"

namespace trundle::TRUNDLE_ISA {

struct NormalOfFace {
  // Flat: a face has one normal.
  F3 operator()(const View&, const Solid& solid, const F3&, I ids, I mask) const {
    F3 normal = {F{}, F{}, F{}};
    const I faces = ids - solid.first_id;
    for (int i = 0; i < kLanes; ++i) {
      if (!mask[i]) continue;
      const float* from = solid.mesh->normals + 3 * (int64_t)faces[i];
      normal.x[i] = from[0];
      normal.y[i] = from[1];
      normal.z[i] = from[2];
    }
    return normal;
  }
};

inline I to_byte(F share) {
  return to_int(max(min(share * 255.0f + 0.5f, splat(255.0f)), F{}));  // in this order, NaN is 255
}

template <typename Normal>
void shade_solid(const View& view, const Solid& solid, const Lighting& lighting, const Buffers& buffers,
                 Normal normal_of) {
  const float* axes = solid.axes;
  const float step = 1.0f / view.focal;
  const int first = solid.left / kLanes * kLanes;
  for (int row = solid.top; row < solid.bottom; ++row) {
    const float z = (view.centre_v - ((float)row + 0.5f)) * step;
    for (int column = first; column < solid.right; column += kLanes) {
      const int at = row * view.stride + column;
      const I ids = load(buffers.id + at);
      const I mask = (ids >= solid.first_id) & (ids < solid.first_id + solid.id_count);
      if (!any(mask)) continue;
      const F depth = 1.0f / load(buffers.nearness + at);
      const F y = (view.centre_u - (counting() + ((float)column + 0.5f))) * step;
      const F3 point = {depth, depth * y, depth * z};
      F3 n = normal_of(view, solid, point, ids, mask);
      n = {axes[0] * n.x + axes[3] * n.y + axes[6] * n.z, axes[1] * n.x + axes[4] * n.y + axes[7] * n.z,
           axes[2] * n.x + axes[5] * n.y + axes[8] * n.z};
      n = n * (1.0f / sqrt(dot(n, n)));
      F3 light = {splat(lighting.ambient[0]), splat(lighting.ambient[1]), splat(lighting.ambient[2])};
      for (int i = 0; i < lighting.light_count; ++i) {
        const Light& lamp = lighting.lights[i];
        const F facing =
            max(n.x * lamp.towards[0] + n.y * lamp.towards[1] + n.z * lamp.towards[2], F{});
        light.x += facing * lamp.diffuse[0];
        light.y += facing * lamp.diffuse[1];
        light.z += facing * lamp.diffuse[2];
      }
      const I colour = to_byte(light.x * solid.colour[0]) | to_byte(light.y * solid.colour[1]) << 8 |
                       to_byte(light.z * solid.colour[2]) << 16;
      store(buffers.colour + at, select(mask, colour, load(buffers.colour + at)));
      if (buffers.segment)
        store(buffers.segment + at, select(mask, splat(solid.index), load(buffers.segment + at)));
    }
  }
}

}  // namespace trundle::TRUNDLE_ISA
