// Pose with the members pos and rot, as in Gazebo up to 8.
#ifndef GAZEBO_MATH_POSE_HH_
#define GAZEBO_MATH_POSE_HH_

#include <ignition/math/Pose3.hh>

#include <gazebo/math/Quaternion.hh>
#include <gazebo/math/Vector3.hh>

namespace gazebo {
namespace math {

class Pose {
 public:
  static const Pose Zero;

  Pose() {}
  Pose(const Vector3& pos, const Quaternion& rot) : pos(pos), rot(rot) {}
  Pose(double x, double y, double z, double roll, double pitch, double yaw) : pos(x, y, z), rot(roll, pitch, yaw) {}
  Pose(const ignition::math::Pose3d& pose) : pos(pose.Pos()), rot(pose.Rot()) {}  // NOLINT: implicit as in the original
  operator ignition::math::Pose3d() const { return Ign(); }
  ignition::math::Pose3d Ign() const { return ignition::math::Pose3d(pos.Ign(), rot.Ign()); }

  void Set(const Vector3& p, const Quaternion& q) { *this = Pose(p, q); }
  void Set(const Vector3& p, const Vector3& rpy) { *this = Pose(p, Quaternion(rpy)); }
  void Set(double x, double y, double z, double roll, double pitch, double yaw) {
    *this = Pose(x, y, z, roll, pitch, yaw);
  }
  void Reset() { *this = Pose(); }
  bool IsFinite() const { return Ign().IsFinite(); }
  Pose GetInverse() const { return Ign().Inverse(); }
  Vector3 CoordPositionAdd(const Vector3& p) const { return Ign().CoordPositionAdd(p.Ign()); }
  Vector3 CoordPositionAdd(const Pose& o) const { return Ign().CoordPositionAdd(o.Ign()); }
  Vector3 CoordPositionSub(const Pose& o) const { return Ign().CoordPositionSub(o.Ign()); }
  Quaternion CoordRotationAdd(const Quaternion& q) const { return Ign().CoordRotationAdd(q.Ign()); }
  Quaternion CoordRotationSub(const Quaternion& q) const { return Ign().CoordRotationSub(q.Ign()); }
  Pose CoordPoseSolve(const Pose& b) const { return Ign().CoordPoseSolve(b.Ign()); }
  Pose RotatePositionAboutOrigin(const Quaternion& q) const { return Pose(q * pos, rot); }

  Pose operator+(const Pose& o) const { return Ign() + o.Ign(); }
  Pose operator-(const Pose& o) const { return Ign() - o.Ign(); }
  Pose operator-() const { return GetInverse(); }
  Pose operator*(const Pose& o) const { return Ign() + o.Ign(); }
  const Pose& operator+=(const Pose& o) { return *this = *this + o; }
  const Pose& operator-=(const Pose& o) { return *this = *this - o; }
  bool operator==(const Pose& o) const { return Ign() == o.Ign(); }
  bool operator!=(const Pose& o) const { return !(*this == o); }
  friend std::ostream& operator<<(std::ostream& out, const Pose& pose) { return out << pose.pos << ' ' << pose.rot; }
  friend std::istream& operator>>(std::istream& in, Pose& pose) { return in >> pose.pos >> pose.rot; }

  Vector3 pos;
  Quaternion rot;
};

}  // namespace math
}  // namespace gazebo

#endif
