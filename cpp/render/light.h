// Lights and their shadow maps.
#pragma once

#include <optional>
#include <vector>

#include "kernel.h"
#include "transform.h"

namespace trundle {

struct LightSpec {
  LightKind kind = LightKind::kDirectional;
  int32_t body = -1;                     // body to which the light is fixed; -1: the world
  Vec3 position{}, direction{0, 0, -1};  // in the body frame
  std::array<float, 3> diffuse{}, specular{};
  float constant = 1, linear = 0, quadratic = 0, range = 1e9f;
  float inner_angle = 0, outer_angle = 1, falloff = 1;  // [rad] full cone angles
  bool casts_shadows = false;
};

int32_t tile_rows(int32_t rows);
size_t tile_count(const View& view);

// Corners of a shadow caster's bounding box, in the world.
using BoxCorners = std::array<Vec3, 8>;

struct ShadowMapImage {
  Transform world_from_view;
  View view;
  float texel;
  std::vector<float> inverse_depth, tile_max_inverse_depth;  // as in ShadowMap

  // Extend tile_max_inverse_depth by a caster, before the caster is rasterized.
  void add_caster(const Renderable& caster);
};

// Empty map that covers all casters; nothing without casters.
std::optional<ShadowMapImage> make_shadow_map(const LightSpec& light, const Transform& world_from_body,
                                              const std::vector<BoxCorners>& casters);

// In the camera frame. The map may be null; the result points to it.
Light light_in_camera(const LightSpec& light, const Transform& world_from_body, const Transform& world_from_camera,
                      const ShadowMap* map);
ShadowMap shadow_map_in_camera(const ShadowMapImage& map, const Transform& world_from_camera);

}  // namespace trundle
