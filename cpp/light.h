// Lights, and what they see.
#pragma once

#include <optional>
#include <vector>

#include "kernel.h"
#include "place.h"

namespace trundle {

struct LightSpec {
  LightKind kind = LightKind::kDirectional;
  int32_t body = -1;  // that it rides on; -1: the world
  Vec3 position{}, direction{0, 0, -1};  // where it is and where it shines to, in the body's frame
  std::array<float, 3> diffuse{}, specular{};
  float constant = 1, linear = 0, quadratic = 0, range = 1e9f;
  float inner_angle = 0, outer_angle = 1, falloff = 1;  // [rad] from rim to rim
  bool casts_shadows = false;
};

int32_t rows_of_tiles(int32_t rows);
size_t tiles_of(const View& view);

// A caster's corners in the world.
using Corners = std::array<Vec3, 8>;

struct LightMap {
  Frame world_from_view;
  View view;
  float texel;
  std::vector<float> nearness, nearest;  // as a ShadowMap's

  // Takes note of what casts a shadow, before it is drawn.
  void cover(const Solid& caster);
};

// A view from the light on everything that casts shadows; nothing where nothing does.
std::optional<LightMap> look_from(const LightSpec& light, const Frame& world_from_body,
                                  const std::vector<Corners>& casters);

// As a camera sees it; the map may be null, and must stay where it is.
Light light_for(const LightSpec& light, const Frame& world_from_body, const Frame& world_from_camera,
                const ShadowMap* map);
ShadowMap map_for(const LightMap& map, const Frame& world_from_camera);

}  // namespace trundle
