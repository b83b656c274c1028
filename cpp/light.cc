#include "light.h"

#include <algorithm>
#include <cmath>

namespace trundle {

int32_t rows_of_tiles(int32_t rows) { return (rows + kTileHeight - 1) / kTileHeight; }

size_t tiles_of(const View& view) { return (size_t)view.tile_stride() * (size_t)rows_of_tiles(view.height); }

namespace {

constexpr double kFinest = 0.01;  // [m] that a texel of a map should be
constexpr int32_t kSmallest = 512, kLargest = 2048;
constexpr int32_t kPadding = 16;  // rows that are a power of two apart would share one line of the cache
constexpr float kNothing = -3e38f;

LightMap map_of(const Frame& world_from_view, int32_t size, double focal, double near_, double far_, bool parallel) {
  LightMap map;
  map.world_from_view = world_from_view;
  map.view = {size, size, size + kPadding, size * 0.5f, size * 0.5f, (float)focal, (float)near_, (float)far_, parallel};
  map.texel = (float)(1.0 / focal);
  const float nothing = parallel ? kNothing : 0.0f;
  map.nearness.assign((size_t)map.view.stride * (size_t)size, nothing);
  map.nearest.assign(tiles_of(map.view), nothing);
  return map;
}

}  // namespace

void LightMap::cover(const Solid& caster) {
  const int32_t left = std::max(caster.left - 1, 0) / kTileWidth, right = (caster.right - 1) / kTileWidth;
  for (int32_t top = std::max(caster.top - 1, 0) / kTileHeight; top <= (caster.bottom - 1) / kTileHeight; ++top)
    for (int32_t tile = left; tile <= right; ++tile) {
      float& most = nearest[(size_t)top * (size_t)view.tile_stride() + (size_t)tile];
      most = std::max(most, caster.nearest);
    }
}

std::optional<LightMap> look_from(const LightSpec& light, const Frame& world_from_body,
                                  const std::vector<Corners>& casters) {
  const Vec3 along = world_from_body.turn(light.direction);
  if (casters.empty() || light.kind == LightKind::kPoint) return std::nullopt;
  if (light.kind == LightKind::kSpot) {
    const double half = std::min((double)light.outer_angle * 0.5, 1.4);
    const Frame view = Frame::looking(along, world_from_body.move(light.position));
    return map_of(view, 2 * kSmallest, kSmallest / std::tan(half), 0.01, light.range, false);
  }
  Frame view = Frame::looking(along, {});
  Vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
  for (const Corners& corners : casters)
    for (const Vec3& corner : corners) {
      const Vec3 seen = view.turn_back(corner);
      for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], seen[i]), high[i] = std::max(high[i], seen[i]);
    }
  const double extent = std::max({high[1] - low[1], high[2] - low[2], 1e-3});
  if (!std::isfinite(extent) || !std::isfinite(high[0] - low[0])) return std::nullopt;
  int32_t size = kSmallest;
  while (size < kLargest && extent / size > kFinest) size *= 2;
  view.position = view.turn({low[0] - 1.0, (low[1] + high[1]) * 0.5, (low[2] + high[2]) * 0.5});
  return map_of(view, size, (size - 4) / extent, 0.0, high[0] - low[0] + 2.0, true);
}

ShadowMap map_for(const LightMap& map, const Frame& world_from_camera) {
  ShadowMap seen{map.nearness.data(), map.nearest.data(), map.view, {}, {}, map.texel};
  const Frame view_from_camera = map.world_from_view.inverse() * world_from_camera;
  for (int i = 0; i < 9; ++i) seen.turn[i] = (float)view_from_camera.rotation[i];
  for (int i = 0; i < 3; ++i) seen.shift[i] = (float)view_from_camera.position[i];
  return seen;
}

Light light_for(const LightSpec& light, const Frame& world_from_body, const Frame& world_from_camera,
                const ShadowMap* map) {
  Light seen{};
  seen.kind = light.kind;
  const Vec3 along = world_from_camera.turn_back(world_from_body.turn(light.direction));
  const Vec3 place = world_from_camera.move_back(world_from_body.move(light.position));
  for (int i = 0; i < 3; ++i) {
    seen.towards[i] = (float)-along[i];
    seen.place[i] = (float)place[i];
    seen.diffuse[i] = light.diffuse[i];
    seen.specular[i] = light.specular[i];
  }
  seen.constant = light.constant, seen.linear = light.linear, seen.quadratic = light.quadratic;
  seen.range = light.range, seen.falloff = light.falloff;
  const double outer = std::cos(light.outer_angle * 0.5);
  seen.cos_outer = (float)outer;
  seen.cos_inner = (float)std::max(std::cos(std::min(light.inner_angle, light.outer_angle) * 0.5), outer + 1e-4);
  seen.shadow = map;
  return seen;
}

}  // namespace trundle
