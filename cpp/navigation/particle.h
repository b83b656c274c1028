// One hypothesis of the robot's pose.
#pragma once

#include "planar_pose.h"

namespace trundle::navigation {

struct Particle {
  PlanarPose pose;  // pose of the robot in the map
  double weight = 0.0;
};

}  // namespace trundle::navigation
