// Blinn-Phong shading: ambient, and diffuse and specular light of each light less its shadow, plus emission; then fog.
#pragma once

#include "intersect.h"
#include "kernel.h"
#include "simd.h"
#include "texture.h"

namespace trundle::TRUNDLE_ISA {

inline Ints to_byte(Floats share) {
  return to_int(max(min(share * 255.0f + 0.5f, splat(255.0f)), Floats{}));  // in this order, NaN becomes 255
}

inline Floats3 clamp_to_white(const Floats3& color) {
  const Floats one = splat(1.0f);
  return {min(color.x, one), min(color.y, one), min(color.z, one)};
}

inline Floats saturate(Floats value) { return max(min(value, splat(1.0f)), Floats{}); }

// Percentage-closer filter over the four nearest texels: 1 lit, 0 in shadow.
inline Floats shadow_factor(const ShadowMap& map, const Floats3& point, const Floats3& normal, Floats facing,
                            float off) {
  const View& view = map.view;
  Floats3 p = rotate(map.rotation, point);
  p = {p.x + map.translation[0], p.y + map.translation[1], p.z + map.translation[2]};
  const Floats texel = view.orthographic ? splat(map.texel) : abs(p.x) * map.texel;
  // Against self-shadowing: offset along the normal, and a bias that grows as the light grazes.
  const Floats above = texel * 1.5f + off;
  const Floats3 n = rotate(map.rotation, normal);
  p = p + n * above;
  const Ints ahead = p.x > view.near_;
  const Floats depth = select(ahead, p.x, splat(1.0f)),
               scale = view.orthographic ? splat(view.focal) : view.focal / depth;
  const Floats u = view.centre_u - p.y * scale - 0.5f, v = view.centre_v - p.z * scale - 0.5f;
  const Ints inside = ahead & (u >= 0.0f) & (v >= 0.0f) & (u < static_cast<float>(view.width - 1)) &
                      (v < static_cast<float>(view.height - 1));
  if (!any(inside)) return splat(1.0f);
  const Floats slope = sqrt(max(1.0f - facing * facing, Floats{})) / max(facing, splat(1e-3f));
  const Floats bias = texel * (1.0f + min(slope, splat(8.0f))) * 0.5f;
  const Floats inverse_depth = view.orthographic ? bias - depth : 1.0f / max(depth - bias, splat(1e-6f));
  const Floats left = floor(select(inside, u, Floats{})), top = floor(select(inside, v, Floats{}));
  const Ints row = to_int(top), column = to_int(left);
  static_assert(kTileWidth == 16 && kTileHeight == 8);
  const Floats nearest = gather(map.tile_max_inverse_depth, (row >> 3) * view.tile_stride() + (column >> 4));
  if (!any(inside & (nearest > inverse_depth))) return splat(1.0f);
  const Floats x = select(inside, u, Floats{}) - left, y = select(inside, v, Floats{}) - top;
  const Ints at = row * view.stride + column;
  const Floats one = splat(1.0f);
  const Floats a = select(gather(map.inverse_depth, at) > inverse_depth, Floats{}, one);
  const Floats b = select(gather(map.inverse_depth, at + 1) > inverse_depth, Floats{}, one);
  const Floats c = select(gather(map.inverse_depth, at + view.stride) > inverse_depth, Floats{}, one);
  const Floats d = select(gather(map.inverse_depth, at + view.stride + 1) > inverse_depth, Floats{}, one);
  const Floats upper = a + x * (b - a), lower = c + x * (d - c);
  return select(inside, upper + y * (lower - upper), one);
}

struct LightSum {
  Floats3 diffuse, specular;
};

// True if a highlight can change a pixel by at least half a level of 255.
inline bool has_highlight(const Material& material, const Light& light) {
  float maximum = 0.0f;
  for (int i = 0; i < 3; ++i) {
    const float shine = material.specular[i] * light.specular[i];
    if (shine > maximum) maximum = shine;
  }
  return maximum >= 0.5f / 255.0f;
}

__attribute__((always_inline)) inline void add_light(const Light& light, const Renderable& renderable,
                                                     const Floats3& point, const Floats3& n, const Floats3& to_eye,
                                                     LightSum& sum) {
  const Material& material = *renderable.material;
  Floats3 to_light = splat(light.to_light);
  Floats strength = splat(1.0f);
  if (light.kind != LightKind::kDirectional) {
    const Floats3 offset_to_light = {light.position[0] - point.x, light.position[1] - point.y,
                                     light.position[2] - point.z};
    const Floats distance = sqrt(dot(offset_to_light, offset_to_light));
    to_light = offset_to_light * (1.0f / max(distance, splat(1e-6f)));
    strength = 1.0f / max(light.constant + distance * (light.linear + distance * light.quadratic), splat(1e-3f));
    strength = select(distance <= light.range, strength, Floats{});
    if (light.kind == LightKind::kSpot) {
      const Floats off_axis = dot(to_light, splat(light.to_light));
      const Floats share = saturate((off_axis - light.cos_outer) * (1.0f / (light.cos_inner - light.cos_outer)));
      strength *= pow(share, light.falloff);
    }
  }
  const Floats facing = max(dot(n, to_light), Floats{});
  const Ints lit_side = (facing > 0.0f) & (strength > 0.0f);
  if (!any(lit_side)) return;
  if (light.shadow) strength *= shadow_factor(*light.shadow, point, n, facing, renderable.lod_error);
  strength = select(lit_side, strength, Floats{});
  sum.diffuse = sum.diffuse + splat(light.diffuse) * (facing * strength);
  if (!has_highlight(material, light)) return;
  const Floats3 half = to_light + to_eye;
  const Floats gloss =
      pow(max(dot(n, half), Floats{}) / sqrt(max(dot(half, half), splat(1e-12f))), material.shininess) * strength;
  sum.specular = sum.specular + splat(light.specular) * gloss;
}

inline Floats fog_transmittance(const Fog& fog, Floats depth) {
  if (fog.kind == FogKind::kLinear) return saturate((fog.end - depth) * (1.0f / (fog.end - fog.start)));
  const Floats thick = depth * (fog.density * 1.44269504f);
  return exp2(fog.kind == FogKind::kExponential ? -thick : -thick * (depth * fog.density));
}

inline Floats3 normal_of_face(const Triangles& mesh, Ints faces, Ints mask) {
  Floats n[4];
  gather_four(mesh.normals, (faces & mask) * 4, n);
  return {n[0], n[1], n[2]};
}

// Smooth normal, of about unit length.
inline Floats3 interpolated_normal(const Triangles& mesh, const Floats3& p, Ints faces, Ints mask) {
  const Ints at = (faces & mask) * 12;
  Floats n[3];
  for (int i = 0; i < 3; ++i) {
    Floats slope[4];
    gather_four(mesh.normal_planes + 4 * i, at, slope);
    const Floats value = slope[0] * p.x + slope[1] * p.y + slope[2] * p.z + slope[3];
    n[i] = max(min(value, splat(1.0f)), splat(-1.0f));  // thin faces: rounding may leave the range
  }
  return {n[0], n[1], n[2]};
}

inline Floats3 operator*(const Floats3& a, const Floats3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

inline Floats3 normalized(const Floats3& v) { return v * (1.0f / sqrt(max(dot(v, v), splat(1e-20f)))); }

template <ShapeKind kind>
void shade_shape(const View& view, const Renderable& renderable, const Lighting& lighting, const Buffers& buffers) {
  const Material& material = *renderable.material;
  const float step = 1.0f / view.focal;
  const bool transparent = material.opacity < 1.0f;
  const int first = renderable.left / kLanes * kLanes;
  int last_level = 0;
  bool needs_eye = material.texture;
  for (int i = 0; i < lighting.light_count; ++i) needs_eye |= has_highlight(material, lighting.lights[i]);
  const Floats3 up = normalized(inverse_rotate(renderable.axes, {Floats{}, Floats{}, splat(1.0f)}));
  for (int row = renderable.top; row < renderable.bottom; ++row) {
    const float z = (view.centre_v - (static_cast<float>(row) + 0.5f)) * step;
    for (int column = first; column < renderable.right; column += kLanes) {
      const int at = row * view.stride + column;
      const Ints ids = load(buffers.id + at);
      const Ints mask = (ids >= renderable.first_id) & (ids < renderable.first_id + renderable.id_count);
      if (!any(mask)) continue;
      const Floats depth = 1.0f / load(buffers.inverse_depth + at);
      const Floats y = (view.centre_u - (lane_indices() + (static_cast<float>(column) + 0.5f))) * step;
      const Floats3 point = {depth, depth * y, depth * z};
      const Floats3 local = splat(renderable.eye) + rotate(renderable.axes, point);
      Floats3 outward;
      if constexpr (kind == ShapeKind::kMesh) {
        outward = renderable.mesh->normal_planes
                      ? interpolated_normal(*renderable.mesh, local, ids - renderable.first_id, mask)
                      : normal_of_face(*renderable.mesh, ids - renderable.first_id, mask);
      } else {
        outward = normal_at<kind>(renderable, local);
      }
      Floats3 n = up, to_eye = {Floats{}, Floats{}, Floats{}};
      if constexpr (kind != ShapeKind::kPlane) {
        const bool is_unit = kind == ShapeKind::kMesh && !renderable.mesh->normal_planes;
        n = inverse_rotate(renderable.axes, outward);
        if (!is_unit) n = normalized(n);
      }
      if (needs_eye) to_eye = point * (-1.0f / sqrt(dot(point, point)));
      const Floats none = Floats{};
      LightSum sum = {{none, none, none}, {none, none, none}};
      for (int i = 0; i < lighting.light_count; ++i) add_light(lighting.lights[i], renderable, point, n, to_eye, sum);
      // Light is clamped to white before the texture is applied, as in Ogre's shaders.
      sum.diffuse = clamp_to_white(splat(lighting.ambient) * splat(material.ambient) +
                                   sum.diffuse * splat(material.diffuse) + splat(material.emissive));
      sum.specular = clamp_to_white(sum.specular * splat(material.specular));
      if (material.texture) {
        TextureUv uv;
        if constexpr (kind == ShapeKind::kMesh)
          uv = uv_of_face(*renderable.mesh, local, ids - renderable.first_id, mask);
        else uv = uv_at<kind>(renderable, local, outward);
        const float* repeat = material.repeat;
        const float maximum = step * (repeat[0] > repeat[1] ? repeat[0] : repeat[1]);
        uv.u = (uv.u - 0.5f) * repeat[0] + 0.5f;
        uv.v = (uv.v - 0.5f) * repeat[1] + 0.5f;
        const Floats across = depth * maximum, facing = max(dot(n, to_eye), splat(0.05f));
        sum.diffuse = sum.diffuse * sample_texture(*material.texture, uv, uv.squared_scale * (across * across) / facing,
                                                   mask, last_level);
      }
      Floats3 color = sum.diffuse + sum.specular;
      if (lighting.fog.kind != FogKind::kNone) {
        const Floats transmittance = fog_transmittance(lighting.fog, depth);
        color = color * transmittance + splat(lighting.fog.color) * (1.0f - transmittance);
      }
      const Ints old = load(buffers.color + at);
      if (transparent) {
        const float behind = (1.0f - material.opacity) / 255.0f;
        const Floats a = splat(material.opacity);
        color = Floats3{saturate(color.x), saturate(color.y), saturate(color.z)} * a;
        color = color + Floats3{channel(old, 0), channel(old, 8), channel(old, 16)} * splat(behind);
      }
      const Ints word = to_byte(color.x) | to_byte(color.y) << 8 | to_byte(color.z) << 16;
      store(buffers.color + at, select(mask, word, old));
      if (buffers.segmentation && !transparent)
        store(buffers.segmentation + at, select(mask, splat(renderable.index), load(buffers.segmentation + at)));
    }
  }
}

}  // namespace trundle::TRUNDLE_ISA
