// Light on what is seen, by Blinn and Phong's model: ambient, diffuse and specular light of each lamp, less its shadows,
// over what the surface gives off itself; then fog.
#pragma once

#include "intersect.h"
#include "kernel.h"
#include "lanes.h"
#include "paint.h"

namespace trundle::TRUNDLE_ISA {

inline I to_byte(F share) {
  return to_int(max(min(share * 255.0f + 0.5f, splat(255.0f)), F{}));  // in this order, NaN is 255
}

inline F3 full(const F3& colour) {
  const F one = splat(1.0f);
  return {min(colour.x, one), min(colour.y, one), min(colour.z, one)};
}

inline F between(F value) { return max(min(value, splat(1.0f)), F{}); }

// What share of the four texels around a point lies open to the light, weighed by how near they are.
inline F lit_share(const ShadowMap& map, const F3& point, const F3& normal, F facing, float off) {
  const View& view = map.view;
  F3 p = turn(map.turn, point);
  p = {p.x + map.shift[0], p.y + map.shift[1], p.z + map.shift[2]};
  const F texel = view.parallel ? splat(map.texel) : abs(p.x) * map.texel;
  // A surface does not shade itself: a look from a little above it, the more the flatter the light falls.
  const F above = texel * 1.5f + off;
  const F3 n = turn(map.turn, normal);
  p = p + n * above;
  const I ahead = p.x > view.near_;
  const F depth = select(ahead, p.x, splat(1.0f)), scale = view.parallel ? splat(view.focal) : view.focal / depth;
  const F u = view.centre_u - p.y * scale - 0.5f, v = view.centre_v - p.z * scale - 0.5f;
  const I inside = ahead & (u >= 0.0f) & (v >= 0.0f) & (u < (float)(view.width - 1)) & (v < (float)(view.height - 1));
  if (!any(inside)) return splat(1.0f);
  const F slope = sqrt(max(1.0f - facing * facing, F{})) / max(facing, splat(1e-3f));
  const F bias = texel * (1.0f + min(slope, splat(8.0f))) * 0.5f;
  const F nearness = view.parallel ? bias - depth : 1.0f / max(depth - bias, splat(1e-6f));
  const F left = floor(select(inside, u, F{})), top = floor(select(inside, v, F{}));
  const I row = to_int(top), column = to_int(left);
  static_assert(kTileWidth == 16 && kTileHeight == 8);
  const F nearest = gather(map.nearest, (row >> 3) * view.tile_stride() + (column >> 4));
  if (!any(inside & (nearest > nearness))) return splat(1.0f);
  const F x = select(inside, u, F{}) - left, y = select(inside, v, F{}) - top;
  const I at = row * view.stride + column;
  const F one = splat(1.0f);
  const F a = select(gather(map.nearness, at) > nearness, F{}, one);
  const F b = select(gather(map.nearness, at + 1) > nearness, F{}, one);
  const F c = select(gather(map.nearness, at + view.stride) > nearness, F{}, one);
  const F d = select(gather(map.nearness, at + view.stride + 1) > nearness, F{}, one);
  const F upper = a + x * (b - a), lower = c + x * (d - c);
  return select(inside, upper + y * (lower - upper), one);
}

struct Lit {
  F3 diffuse, specular;
};

// Whether a highlight would be seen.
inline bool is_glossy(const Look& look, const Light& lamp) {
  float most = 0.0f;
  for (int i = 0; i < 3; ++i) {
    const float shine = look.specular[i] * lamp.specular[i];
    if (shine > most) most = shine;
  }
  return most >= 0.5f / 255.0f;
}

__attribute__((always_inline)) inline void add_light(const Light& lamp, const Solid& solid, const F3& point, const F3& n,
                                                     const F3& back, Lit& lit) {
  const Look& look = *solid.look;
  F3 towards = splat(lamp.towards);
  F strength = splat(1.0f);
  if (lamp.kind != LightKind::kDirectional) {
    const F3 way = {lamp.place[0] - point.x, lamp.place[1] - point.y, lamp.place[2] - point.z};
    const F distance = sqrt(dot(way, way));
    towards = way * (1.0f / max(distance, splat(1e-6f)));
    strength = 1.0f / max(lamp.constant + distance * (lamp.linear + distance * lamp.quadratic), splat(1e-3f));
    strength = select(distance <= lamp.range, strength, F{});
    if (lamp.kind == LightKind::kSpot) {
      const F off_axis = dot(towards, splat(lamp.towards));
      const F share = between((off_axis - lamp.cos_outer) * (1.0f / (lamp.cos_inner - lamp.cos_outer)));
      strength *= pow(share, lamp.falloff);
    }
  }
  const F facing = max(dot(n, towards), F{});
  const I lit_side = (facing > 0.0f) & (strength > 0.0f);
  if (!any(lit_side)) return;
  if (lamp.shadow) strength *= lit_share(*lamp.shadow, point, n, facing, solid.off);
  strength = select(lit_side, strength, F{});
  lit.diffuse = lit.diffuse + splat(lamp.diffuse) * (facing * strength);
  if (!is_glossy(look, lamp)) return;
  const F3 half = towards + back;
  const F gloss = pow(max(dot(n, half), F{}) / sqrt(max(dot(half, half), splat(1e-12f))), look.shininess) * strength;
  lit.specular = lit.specular + splat(lamp.specular) * gloss;
}

inline F clear_share(const Fog& fog, F depth) {
  if (fog.kind == FogKind::kLinear) return between((fog.end - depth) * (1.0f / (fog.end - fog.start)));
  const F thick = depth * (fog.density * 1.44269504f);
  return exp2(fog.kind == FogKind::kExponential ? -thick : -thick * (depth * fog.density));
}

inline F3 normal_of_face(const Triangles& mesh, I faces, I mask) {
  F n[4];
  gather_four(mesh.normals, (faces & mask) * 4, n);
  return {n[0], n[1], n[2]};
}

// What runs over the edges of faces, of about unit length.
inline F3 normal_at_point(const Triangles& mesh, const F3& p, I faces, I mask) {
  const I at = (faces & mask) * 12;
  F n[3];
  for (int i = 0; i < 3; ++i) {
    F slope[4];
    gather_four(mesh.bend + 4 * i, at, slope);
    const F value = slope[0] * p.x + slope[1] * p.y + slope[2] * p.z + slope[3];
    n[i] = max(min(value, splat(1.0f)), splat(-1.0f));  // beside thin faces, single precision leaves the range
  }
  return {n[0], n[1], n[2]};
}

inline F3 operator*(const F3& a, const F3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

inline F3 unit(const F3& v) { return v * (1.0f / sqrt(max(dot(v, v), splat(1e-20f)))); }

template <Kind kind>
void shade_solid(const View& view, const Solid& solid, const Lighting& lighting, const Buffers& buffers) {
  const Look& look = *solid.look;
  const float step = 1.0f / view.focal;
  const bool see_through = look.opacity < 1.0f;
  const int first = solid.left / kLanes * kLanes;
  int usual_level = 0;
  bool heeds_eye = look.texture;
  for (int i = 0; i < lighting.light_count; ++i) heeds_eye |= is_glossy(look, lighting.lights[i]);
  const F3 up = unit(turn_back(solid.axes, {F{}, F{}, splat(1.0f)}));
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
      const F3 local = splat(solid.eye) + turn(solid.axes, point);
      F3 outward;
      if constexpr (kind == Kind::kMesh) {
        outward = solid.mesh->bend ? normal_at_point(*solid.mesh, local, ids - solid.first_id, mask)
                                   : normal_of_face(*solid.mesh, ids - solid.first_id, mask);
      } else {
        outward = normal_at<kind>(solid, local);
      }
      F3 n = up, back = {F{}, F{}, F{}};
      if constexpr (kind != Kind::kPlane) {
        const bool is_unit = kind == Kind::kMesh && !solid.mesh->bend;
        n = turn_back(solid.axes, outward);
        if (!is_unit) n = unit(n);
      }
      if (heeds_eye) back = point * (-1.0f / sqrt(dot(point, point)));
      const F none = F{};
      Lit lit = {{none, none, none}, {none, none, none}};
      for (int i = 0; i < lighting.light_count; ++i) add_light(lighting.lights[i], solid, point, n, back, lit);
      // As Ogre's shaders: all that a surface sends back is at most white, and then tinted by its texture.
      lit.diffuse = full(splat(lighting.ambient) * splat(look.ambient) + lit.diffuse * splat(look.diffuse) + splat(look.emissive));
      lit.specular = full(lit.specular * splat(look.specular));
      if (look.texture) {
        Layout layout;
        if constexpr (kind == Kind::kMesh) {
          layout = layout_of_face(*solid.mesh, local, ids - solid.first_id, mask);
        } else {
          layout = layout_at<kind>(solid, local, outward);
        }
        const float *repeat = look.repeat;
        const float most = step * (repeat[0] > repeat[1] ? repeat[0] : repeat[1]);
        layout.u = (layout.u - 0.5f) * repeat[0] + 0.5f, layout.v = (layout.v - 0.5f) * repeat[1] + 0.5f;
        const F across = depth * most, facing = max(dot(n, back), splat(0.05f));
        lit.diffuse = lit.diffuse * texel_at(*look.texture, layout, layout.squared_scale * (across * across) / facing, mask, usual_level);
      }
      F3 colour = lit.diffuse + lit.specular;
      if (lighting.fog.kind != FogKind::kNone) {
        const F clear = clear_share(lighting.fog, depth);
        colour = colour * clear + splat(lighting.fog.colour) * (1.0f - clear);
      }
      const I before = load(buffers.colour + at);
      if (see_through) {
        const float behind = (1.0f - look.opacity) / 255.0f;
        const F a = splat(look.opacity);
        colour = F3{between(colour.x), between(colour.y), between(colour.z)} * a;
        colour = colour + F3{channel(before, 0), channel(before, 8), channel(before, 16)} * splat(behind);
      }
      const I word = to_byte(colour.x) | to_byte(colour.y) << 8 | to_byte(colour.z) << 16;
      store(buffers.colour + at, select(mask, word, before));
      if (buffers.segment && !see_through)
        store(buffers.segment + at, select(mask, splat(solid.index), load(buffers.segment + at)));
    }
  }
}

}  // namespace trundle::TRUNDLE_ISA
