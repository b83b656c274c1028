#include "light.h"

#include <algorithm>
#include <cmath>

namespace trundle {

int32_t tile_rows(int32_t rows) { return (rows + kTileHeight - 1) / kTileHeight; }

size_t tile_count(const View& view) {
  return static_cast<size_t>(view.tile_stride()) * static_cast<size_t>(tile_rows(view.height));
}

namespace {

constexpr double kTexelSize = 0.01;  // [m] target width of a texel
constexpr int32_t kMinMapSize = 512, kMaxMapSize = 2048;
constexpr int32_t kPadding = 16;  // texels; rows a power of two apart would share cache lines
constexpr float kNoDepth = -3e38f;

ShadowMapImage blank_shadow_map(const Transform& world_from_view, int32_t size, double focal, double near_, double far_,
                                bool orthographic) {
  ShadowMapImage map;
  map.world_from_view = world_from_view;
  map.view = {size,
              size,
              size + kPadding,
              size * 0.5f,
              size * 0.5f,
              static_cast<float>(focal),
              static_cast<float>(near_),
              static_cast<float>(far_),
              orthographic};
  map.texel = static_cast<float>(1.0 / focal);
  const float nothing = orthographic ? kNoDepth : 0.0f;
  map.inverse_depth.assign(static_cast<size_t>(map.view.stride) * static_cast<size_t>(size), nothing);
  map.tile_max_inverse_depth.assign(tile_count(map.view), nothing);
  return map;
}

}  // namespace

void ShadowMapImage::add_caster(const Renderable& caster) {
  const int32_t left = std::max(caster.left - 1, 0) / kTileWidth, right = (caster.right - 1) / kTileWidth;
  for (int32_t top = std::max(caster.top - 1, 0) / kTileHeight; top <= (caster.bottom - 1) / kTileHeight; ++top)
    for (int32_t tile = left; tile <= right; ++tile) {
      float& tile_max = tile_max_inverse_depth[static_cast<size_t>(top) * static_cast<size_t>(view.tile_stride()) +
                                               static_cast<size_t>(tile)];
      tile_max = std::max(tile_max, caster.max_inverse_depth);
    }
}

std::optional<ShadowMapImage> make_shadow_map(const LightSpec& light, const Transform& world_from_body,
                                              const std::vector<BoxCorners>& casters) {
  const Vec3 along = world_from_body.rotate(light.direction);
  if (casters.empty() || light.kind == LightKind::kPoint) return std::nullopt;
  if (light.kind == LightKind::kSpot) {
    const double half = std::min(static_cast<double>(light.outer_angle) * 0.5, 1.4);
    const Transform view = Transform::look_along(along, world_from_body.apply(light.position));
    return blank_shadow_map(view, 2 * kMinMapSize, kMinMapSize / std::tan(half), 0.01, light.range, false);
  }
  Transform view = Transform::look_along(along, {});
  Vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
  for (const BoxCorners& corners : casters)
    for (const Vec3& corner : corners) {
      const Vec3 result = view.inverse_rotate(corner);
      for (int i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], result[i]);
        high[i] = std::max(high[i], result[i]);
      }
    }
  const double extent = std::max({high[1] - low[1], high[2] - low[2], 1e-3});
  if (!std::isfinite(extent) || !std::isfinite(high[0] - low[0])) return std::nullopt;
  int32_t size = kMinMapSize;
  while (size < kMaxMapSize && extent / size > kTexelSize) size *= 2;
  view.position = view.rotate({low[0] - 1.0, (low[1] + high[1]) * 0.5, (low[2] + high[2]) * 0.5});
  return blank_shadow_map(view, size, (size - 4) / extent, 0.0, high[0] - low[0] + 2.0, true);
}

ShadowMap shadow_map_in_camera(const ShadowMapImage& map, const Transform& world_from_camera) {
  ShadowMap result{map.inverse_depth.data(), map.tile_max_inverse_depth.data(), map.view, {}, {}, map.texel};
  const Transform view_from_camera = map.world_from_view.inverse() * world_from_camera;
  for (int i = 0; i < 9; ++i) result.rotation[i] = static_cast<float>(view_from_camera.rotation[i]);
  for (int i = 0; i < 3; ++i) result.translation[i] = static_cast<float>(view_from_camera.position[i]);
  return result;
}

Light light_in_camera(const LightSpec& light, const Transform& world_from_body, const Transform& world_from_camera,
                      const ShadowMap* map) {
  Light result{};
  result.kind = light.kind;
  const Vec3 along = world_from_camera.inverse_rotate(world_from_body.rotate(light.direction));
  const Vec3 light_position = world_from_camera.inverse_apply(world_from_body.apply(light.position));
  for (int i = 0; i < 3; ++i) {
    result.to_light[i] = static_cast<float>(-along[i]);
    result.position[i] = static_cast<float>(light_position[i]);
    result.diffuse[i] = light.diffuse[i];
    result.specular[i] = light.specular[i];
  }
  result.constant = light.constant;
  result.linear = light.linear;
  result.quadratic = light.quadratic;
  result.range = light.range;
  result.falloff = light.falloff;
  const double outer = std::cos(light.outer_angle * 0.5);
  result.cos_outer = static_cast<float>(outer);
  result.cos_inner =
      static_cast<float>(std::max(std::cos(std::min(light.inner_angle, light.outer_angle) * 0.5), outer + 1e-4));
  result.shadow = map;
  return result;
}

}  // namespace trundle
