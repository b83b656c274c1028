// Position and rotation of a frame in another.
#ifndef IGNITION_MATH_POSE3_HH_
#define IGNITION_MATH_POSE3_HH_

#include <ignition/math/Quaternion.hh>
#include <ignition/math/Vector3.hh>

namespace ignition {
namespace math {

template <typename T>
class Pose3 {
 public:
  static const Pose3 Zero;

  Pose3() {}
  Pose3(const Vector3<T>& position, const Quaternion<T>& rotation) : p(position), q(rotation) {}
  Pose3(T x, T y, T z, T roll, T pitch, T yaw) : p(x, y, z), q(roll, pitch, yaw) {}
  Pose3(T x, T y, T z, T qw, T qx, T qy, T qz) : p(x, y, z), q(qw, qx, qy, qz) {}

  void Set(const Vector3<T>& position, const Quaternion<T>& rotation) { *this = Pose3(position, rotation); }
  void Set(const Vector3<T>& position, const Vector3<T>& rpy) { *this = Pose3(position, Quaternion<T>(rpy)); }
  void Set(T x, T y, T z, T roll, T pitch, T yaw) { *this = Pose3(x, y, z, roll, pitch, yaw); }
  bool IsFinite() const { return p.IsFinite() && q.IsFinite(); }
  void Correct() {
    p.Correct();
    q.Correct();
  }
  void Reset() { *this = Pose3(); }
  void Round(int digits) {
    p = Vector3<T>(precision(p.X(), digits), precision(p.Y(), digits), precision(p.Z(), digits));
    q.Round(digits);
  }

  const Vector3<T>& Pos() const { return p; }
  Vector3<T>& Pos() { return p; }
  const Quaternion<T>& Rot() const { return q; }
  Quaternion<T>& Rot() { return q; }
  T X() const { return p.X(); }
  T Y() const { return p.Y(); }
  T Z() const { return p.Z(); }
  void SetX(T value) { p.X() = value; }
  void SetY(T value) { p.Y() = value; }
  void SetZ(T value) { p.Z() = value; }
  T Roll() const { return q.Roll(); }
  T Pitch() const { return q.Pitch(); }
  T Yaw() const { return q.Yaw(); }

  // This frame's pose b_from_c and a_from_b give a_from_c: c + b, or b * c.
  Pose3 operator*(const Pose3& o) const { return Pose3(p + q * o.p, (q * o.q).Normalized()); }
  const Pose3& operator*=(const Pose3& o) { return *this = *this * o; }
  Pose3 operator+(const Pose3& o) const { return o * *this; }
  const Pose3& operator+=(const Pose3& o) { return *this = *this + o; }
  Pose3 operator-(const Pose3& o) const { return Pose3(CoordPositionSub(o), CoordRotationSub(o.q)); }
  Pose3 operator-() const { return Inverse(); }
  const Pose3& operator-=(const Pose3& o) { return *this = *this - o; }
  Pose3 Inverse() const {
    const Quaternion<T> inverse = q.Inverse();
    return Pose3(-(inverse * p), inverse);
  }
  Vector3<T> CoordPositionAdd(const Vector3<T>& point) const { return p + q * point; }
  Vector3<T> CoordPositionAdd(const Pose3& o) const { return o.p + o.q * p; }
  Vector3<T> CoordPositionSub(const Pose3& o) const { return o.q.Inverse() * (p - o.p); }
  Quaternion<T> CoordRotationAdd(const Quaternion<T>& rotation) const { return (rotation * q).Normalized(); }
  Quaternion<T> CoordRotationSub(const Quaternion<T>& rotation) const { return (rotation.Inverse() * q).Normalized(); }
  // Pose a for which this = b + a.
  Pose3 CoordPoseSolve(const Pose3& b) const { return *this * b.Inverse(); }
  Pose3 RotatePositionAboutOrigin(const Quaternion<T>& rotation) const { return Pose3(rotation * p, q); }

  bool Equal(const Pose3& o, const T& tolerance) const { return p.Equal(o.p, tolerance) && q.Equal(o.q, tolerance); }
  bool operator==(const Pose3& o) const { return p == o.p && q == o.q; }
  bool operator!=(const Pose3& o) const { return !(*this == o); }
  friend std::ostream& operator<<(std::ostream& out, const Pose3& pose) { return out << pose.p << ' ' << pose.q; }
  friend std::istream& operator>>(std::istream& in, Pose3& pose) { return in >> pose.p >> pose.q; }

 private:
  Vector3<T> p;
  Quaternion<T> q;
};

template <typename T>
const Pose3<T> Pose3<T>::Zero;

typedef Pose3<double> Pose3d;
typedef Pose3<float> Pose3f;
typedef Pose3<int> Pose3i;

}  // namespace math
}  // namespace ignition

#endif
