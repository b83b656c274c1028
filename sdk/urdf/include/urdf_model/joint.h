#pragma once

#include <string>

#include "urdf_model/pose.h"
#include "urdf_model/types.h"

namespace urdf {

class JointDynamics {
 public:
  double damping = 0.0, friction = 0.0;
};
/** [m or rad], [N or N·m], [m/s or rad/s]. */
class JointLimits {
 public:
  double lower = 0.0, upper = 0.0, effort = 0.0, velocity = 0.0;
};
class JointSafety {
 public:
  double soft_upper_limit = 0.0, soft_lower_limit = 0.0, k_position = 0.0, k_velocity = 0.0;
};
class JointCalibration {
 public:
  double reference_position = 0.0;
  std::shared_ptr<double> rising, falling;
};
class JointMimic {
 public:
  double offset = 0.0, multiplier = 1.0;
  std::string joint_name;
};

class Joint {
 public:
  enum { UNKNOWN, REVOLUTE, CONTINUOUS, PRISMATIC, FLOATING, PLANAR, FIXED };
  std::string name;
  int type = UNKNOWN;
  /** Axis in the joint's frame. */
  Vector3 axis = Vector3(1, 0, 0);
  std::string child_link_name, parent_link_name;
  Pose parent_to_joint_origin_transform;
  JointDynamicsSharedPtr dynamics;
  JointLimitsSharedPtr limits;
  JointSafetySharedPtr safety;
  JointCalibrationSharedPtr calibration;
  JointMimicSharedPtr mimic;
};

}  // namespace urdf
