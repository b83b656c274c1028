// Collisions and planners in the Python module `_planning`.
#pragma once

#include <nanobind/nanobind.h>

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "collision_world.h"
#include "state_check.h"

namespace trundle::planning {

// A collision world that several threads may ask: one after another.
struct SharedWorld {
  CollisionWorld world;
  std::size_t variables;  // in a state
  std::mutex mutex;

  SharedWorld(CollisionWorld that, std::size_t variable_count) : world(std::move(that)), variables(variable_count) {}
};

// What Python holds as a shape: one convex shape, or the triangles of a surface.
struct CollisionShape {
  std::vector<std::shared_ptr<const ConvexShape>> parts;
};

void bind_scene(nanobind::module_& module);
void bind_planners(nanobind::module_& module);
void bind_trajectories(nanobind::module_& module);

}  // namespace trundle::planning
