// Rotation with the members w, x, y and z, as in Gazebo up to 8.
#ifndef GAZEBO_MATH_QUATERNION_HH_
#define GAZEBO_MATH_QUATERNION_HH_

#include <ignition/math/Matrix4.hh>
#include <ignition/math/Quaternion.hh>

#include <gazebo/math/Angle.hh>
#include <gazebo/math/Vector3.hh>

namespace gazebo {
namespace math {

class Matrix3 : public ignition::math::Matrix3d {
 public:
  Matrix3() {}
  Matrix3(const ignition::math::Matrix3d& m) : ignition::math::Matrix3d(m) {}  // NOLINT: implicit as in the original
  ignition::math::Matrix3d Ign() const { return *this; }
};

class Matrix4 : public ignition::math::Matrix4d {
 public:
  static const Matrix4 IDENTITY, ZERO;

  Matrix4() {}
  Matrix4(const ignition::math::Matrix4d& m) : ignition::math::Matrix4d(m) {}  // NOLINT: implicit as in the original
  ignition::math::Matrix4d Ign() const { return *this; }
  void SetTranslate(const Vector3& t) { SetTranslation(t.Ign()); }
  Vector3 GetTranslation() const { return Translation(); }
  Matrix4 Inverse() const { return ignition::math::Matrix4d::Inverse(); }
  Matrix4 operator*(const Matrix4& o) const { return static_cast<const ignition::math::Matrix4d&>(*this) * o; }
  Vector3 operator*(const Vector3& v) const { return static_cast<const ignition::math::Matrix4d&>(*this) * v.Ign(); }
};

class Quaternion {
 public:
  Quaternion() : w(1), x(0), y(0), z(0) {}
  Quaternion(const double& w, const double& x, const double& y, const double& z) : w(w), x(x), y(y), z(z) {}
  Quaternion(const double& roll, const double& pitch, const double& yaw)
      : Quaternion(ignition::math::Quaterniond(roll, pitch, yaw)) {}
  Quaternion(const Vector3& axis, const double& angle) : Quaternion(ignition::math::Quaterniond(axis.Ign(), angle)) {}
  explicit Quaternion(const Vector3& rpy) : Quaternion(rpy.x, rpy.y, rpy.z) {}
  Quaternion(const ignition::math::Quaterniond& q)  // NOLINT: implicit as in the original
      : w(q.W()), x(q.X()), y(q.Y()), z(q.Z()) {}
  operator ignition::math::Quaterniond() const { return Ign(); }
  ignition::math::Quaterniond Ign() const { return ignition::math::Quaterniond(w, x, y, z); }

  void Set(double nw, double nx, double ny, double nz) { *this = Quaternion(nw, nx, ny, nz); }
  void SetToIdentity() { *this = Quaternion(); }
  void SetFromEuler(const Vector3& rpy) { *this = Quaternion(rpy); }
  void SetFromEuler(double roll, double pitch, double yaw) { *this = Quaternion(roll, pitch, yaw); }
  void SetFromAxis(const Vector3& axis, double angle) { *this = Quaternion(axis, angle); }
  void SetFromAxis(double ax, double ay, double az, double angle) { *this = Quaternion(Vector3(ax, ay, az), angle); }
  static Quaternion EulerToQuaternion(const Vector3& rpy) { return Quaternion(rpy); }
  static Quaternion EulerToQuaternion(double roll, double pitch, double yaw) { return {roll, pitch, yaw}; }
  Vector3 GetAsEuler() const { return Ign().Euler(); }
  double GetRoll() const { return Ign().Roll(); }
  double GetPitch() const { return Ign().Pitch(); }
  double GetYaw() const { return Ign().Yaw(); }
  Matrix3 GetAsMatrix3() const { return ignition::math::Matrix3d(Ign()); }
  Matrix4 GetAsMatrix4() const { return ignition::math::Matrix4d(Ign()); }
  void GetAsAxis(Vector3& axis, double& angle) const {
    ignition::math::Vector3d a;
    Ign().ToAxis(a, angle);
    axis = a;
  }
  Vector3 GetXAxis() const { return Ign().XAxis(); }
  Vector3 GetYAxis() const { return Ign().YAxis(); }
  Vector3 GetZAxis() const { return Ign().ZAxis(); }
  void Invert() { *this = GetInverse(); }
  Quaternion GetInverse() const { return Ign().Inverse(); }
  void Normalize() { *this = Ign().Normalized(); }
  Vector3 RotateVector(const Vector3& v) const { return Ign() * v.Ign(); }
  Vector3 RotateVectorReverse(const Vector3& v) const { return Ign().RotateVectorReverse(v.Ign()); }
  double Dot(const Quaternion& o) const { return Ign().Dot(o.Ign()); }
  bool IsFinite() const { return Ign().IsFinite(); }
  static Quaternion Slerp(double t, const Quaternion& a, const Quaternion& b, bool shortest = false) {
    return ignition::math::Quaterniond::Slerp(t, a.Ign(), b.Ign(), shortest);
  }

  Quaternion operator+(const Quaternion& o) const { return Ign() + o.Ign(); }
  Quaternion operator-(const Quaternion& o) const { return Ign() - o.Ign(); }
  Quaternion operator-() const { return -Ign(); }
  Quaternion operator*(const Quaternion& o) const { return Ign() * o.Ign(); }
  Quaternion operator*(double value) const { return Ign() * value; }
  Vector3 operator*(const Vector3& v) const { return Ign() * v.Ign(); }
  Quaternion operator*=(const Quaternion& o) { return *this = *this * o; }
  bool operator==(const Quaternion& o) const { return Ign() == o.Ign(); }
  bool operator!=(const Quaternion& o) const { return !(*this == o); }
  friend std::ostream& operator<<(std::ostream& out, const Quaternion& q) { return out << q.Ign(); }
  friend std::istream& operator>>(std::istream& in, Quaternion& q) {
    ignition::math::Quaterniond read;
    in >> read;
    q = read;
    return in;
  }

  double w, x, y, z;
};

}  // namespace math
}  // namespace gazebo

#endif
