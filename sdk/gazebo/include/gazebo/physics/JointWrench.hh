#ifndef GAZEBO_PHYSICS_JOINTWRENCH_HH_
#define GAZEBO_PHYSICS_JOINTWRENCH_HH_

#include <gazebo/math/Vector3.hh>

namespace gazebo {
namespace physics {

// Vector that also has the members x, y and z, which it had up to Gazebo 8.
class WrenchVector : public ignition::math::Vector3d {
 public:
  WrenchVector() {}
  WrenchVector(const ignition::math::Vector3d& v) : ignition::math::Vector3d(v) {}  // NOLINT: implicit as a vector
  WrenchVector(const WrenchVector& v) : WrenchVector(v.Ign()) {}
  WrenchVector& operator=(const ignition::math::Vector3d& v) {
    Set(v.X(), v.Y(), v.Z());
    return *this;
  }
  WrenchVector& operator=(const WrenchVector& v) { return *this = v.Ign(); }
  const ignition::math::Vector3d& Ign() const { return *this; }

  double &x = X(), &y = Y(), &z = Z();
};

class JointWrench {
 public:
  WrenchVector body1Force, body1Torque, body2Force, body2Torque;
};

}  // namespace physics
}  // namespace gazebo

#endif
