// Angle [rad], as in Gazebo up to 8.
#ifndef GAZEBO_MATH_ANGLE_HH_
#define GAZEBO_MATH_ANGLE_HH_

#include <ignition/math/Angle.hh>

#include <gazebo/math/Helpers.hh>

#define GZ_RTOD(r) ((r) * 180.0 / M_PI)
#define GZ_DTOR(d) ((d) * M_PI / 180.0)
#define GZ_NORMALIZE(a) (std::atan2(std::sin(a), std::cos(a)))

namespace gazebo {
namespace math {

class Angle : public ignition::math::Angle {
 public:
  static const Angle Zero, Pi, HalfPi, TwoPi;

  Angle() {}
  Angle(double radian) : ignition::math::Angle(radian) {}                      // NOLINT: implicit as in the original
  Angle(const ignition::math::Angle& angle) : ignition::math::Angle(angle) {}  // NOLINT
  void SetFromRadian(double radian) { Radian(radian); }
  void SetFromDegree(double degree) { Degree(degree); }
  double GetAsRadian() const { return (*this)(); }
  ignition::math::Angle Ign() const { return *this; }
};

}  // namespace math
}  // namespace gazebo

#endif
