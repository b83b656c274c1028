// States of a group whose link goes through given poses, one after another.
#pragma once

#include <vector>

#include "validity.h"

namespace trundle::planning {

enum class FollowEnd { kDone, kUnreachable, kInvalid, kJump };

struct JumpLimits {
  double revolute = 0.0, prismatic = 0.0;  // greatest step of a variable [rad], [m]; 0: any
};

struct FollowedPath {
  std::vector<State> states;  // one per pose reached
  FollowEnd end = FollowEnd::kDone;
};

// Follow poses of a link in the model frame, each from the state before.
FollowedPath follow_poses(Validity& validity, std::span<const double> start, int link, const Vec3& offset,
                          const std::vector<Rigid>& poses, const std::vector<bool>& is_prismatic,
                          const JumpLimits& jumps);

}  // namespace trundle::planning
