#ifndef GAZEBO_PHYSICS_JOINTWRENCH_HH_
#define GAZEBO_PHYSICS_JOINTWRENCH_HH_

#include <ignition/math/Vector3.hh>

namespace gazebo {
namespace physics {

class JointWrench {
 public:
  ignition::math::Vector3d body1Force, body1Torque, body2Force, body2Torque;
};

}  // namespace physics
}  // namespace gazebo

#endif
