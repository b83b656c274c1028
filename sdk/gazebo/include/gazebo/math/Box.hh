// Box along the axes, as in Gazebo up to 8.
#ifndef GAZEBO_MATH_BOX_HH_
#define GAZEBO_MATH_BOX_HH_

#include <ignition/math/Box.hh>

#include <gazebo/math/Vector3.hh>

namespace gazebo {
namespace math {

class Box {
 public:
  Box() {}
  Box(const Vector3& min, const Vector3& max) : min(min), max(max) {}
  Box(const ignition::math::Box& box) : min(box.Min()), max(box.Max()) {}  // NOLINT: implicit as in the original
  ignition::math::Box Ign() const { return ignition::math::Box(min.Ign(), max.Ign()); }
  double GetXLength() const { return max.x - min.x; }
  double GetYLength() const { return max.y - min.y; }
  double GetZLength() const { return max.z - min.z; }
  Vector3 GetSize() const { return max - min; }
  Vector3 GetCenter() const { return (min + max) / 2.0; }
  bool Contains(const Vector3& p) const { return Ign().Contains(p.Ign()); }

  Vector3 min, max;
};

}  // namespace math
}  // namespace gazebo

#endif
