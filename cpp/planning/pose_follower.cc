#include "pose_follower.h"

#include <cmath>
#include <memory>
#include <numbers>

namespace trundle::planning {

FollowedPath follow_poses(Validity& validity, std::span<const double> start, int link, const Vec3& offset,
                          const std::vector<Rigid>& poses, const std::vector<bool>& is_prismatic,
                          const JumpLimits& jumps) {
  FollowedPath followed;
  State state(start.begin(), start.end()), next;
  PoseConstraint target;
  target.link = link;
  target.offset = offset;
  target.orientation = OrientationError::kRotationVector;
  target.regions = {{std::make_shared<ConvexShape>(make_primitive(ShapeKind::kSphere, {})), {}}};
  for (const Rigid& pose : poses) {
    target.regions[0].pose.p = pose * offset;
    target.target = pose.r;
    next = state;
    if (!validity.project(next, {&target, 1})) {
      followed.end = FollowEnd::kUnreachable;
      return followed;
    }
    for (std::size_t k = 0; k < next.size(); ++k) {
      const bool is_circle = validity.space().dimensions()[k].is_circle;
      const double step =
          std::abs(is_circle ? std::remainder(next[k] - state[k], 2.0 * std::numbers::pi) : next[k] - state[k]);
      const double limit = is_prismatic[k] ? jumps.prismatic : jumps.revolute;
      if (limit > 0.0 && step > limit) {
        followed.end = FollowEnd::kJump;
        return followed;
      }
    }
    if (!validity.is_valid(next) || !validity.is_motion_valid(state, next, true)) {
      followed.end = FollowEnd::kInvalid;
      return followed;
    }
    followed.states.push_back(next);
    state = next;
  }
  return followed;
}

}  // namespace trundle::planning
