#include "motion_query.h"

#include <algorithm>

namespace trundle::planning {

PlannedPath solve(Validity& validity, std::span<const double> start, GoalRegion& goals, const MotionQuery& query,
                  Random& random, const Deadline& deadline) {
  PlannedPath found;
  const double resolution = validity.task().resolution;
  for (int repeat = 0; repeat <= query.max_repeats; ++repeat) {
    PlannedPath next = find_path(validity, start, goals, query.planner, random, deadline);
    next.iterations += found.iterations;
    next.nodes += found.nodes;
    found = std::move(next);
    if (found.states.empty()) break;
    if (find_invalid_part(validity, found.states) < 0) {
      if (query.simplifies) simplify(validity, found.states, query.simplifier, random, deadline);
      break;
    }
    found.states.clear();
    validity.set_resolution(validity.task().resolution / 3.0);
  }
  validity.set_resolution(resolution);
  return found;
}

State find_valid_near(Validity& validity, std::span<const double> state, double radius, int attempts, Random& random) {
  State near(state.size());
  for (int i = 0; i < attempts; ++i) {
    const double size = radius * static_cast<double>(i + 1) / attempts;
    for (std::size_t k = 0; k < state.size(); ++k) near[k] = state[k] + random.uniform(-size, size);
    validity.space().clamp(near);
    if (validity.is_constrained() && !validity.project(near)) continue;
    if (validity.is_valid(near)) return near;
  }
  return {};
}

}  // namespace trundle::planning
