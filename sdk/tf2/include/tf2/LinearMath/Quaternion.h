#pragma once

#include "tf2/LinearMath/Vector3.h"

namespace tf2 {

/** Rotation x, y, z, w. */
class Quaternion {
 public:
  Quaternion() : q_{0.0, 0.0, 0.0, 1.0} {}
  Quaternion(const tf2Scalar& x, const tf2Scalar& y, const tf2Scalar& z, const tf2Scalar& w) : q_{x, y, z, w} {}
  /** Rotation about an axis by an angle [rad]. */
  Quaternion(const Vector3& axis, const tf2Scalar& angle) { setRotation(axis, angle); }
  Quaternion(const tf2Scalar& yaw, const tf2Scalar& pitch, const tf2Scalar& roll) { setEuler(yaw, pitch, roll); }

  const tf2Scalar& x() const { return q_[0]; }
  const tf2Scalar& y() const { return q_[1]; }
  const tf2Scalar& z() const { return q_[2]; }
  const tf2Scalar& w() const { return q_[3]; }
  const tf2Scalar& getX() const { return q_[0]; }
  const tf2Scalar& getY() const { return q_[1]; }
  const tf2Scalar& getZ() const { return q_[2]; }
  const tf2Scalar& getW() const { return q_[3]; }
  void setX(tf2Scalar x) { q_[0] = x; }
  void setY(tf2Scalar y) { q_[1] = y; }
  void setZ(tf2Scalar z) { q_[2] = z; }
  void setW(tf2Scalar w) { q_[3] = w; }
  void setValue(const tf2Scalar& x, const tf2Scalar& y, const tf2Scalar& z, const tf2Scalar& w) {
    *this = Quaternion(x, y, z, w);
  }

  void setRotation(const Vector3& axis, const tf2Scalar& angle) {
    const tf2Scalar length = axis.length();
    const tf2Scalar s = length > 0.0 ? std::sin(0.5 * angle) / length : 0.0;
    *this = Quaternion(axis.x() * s, axis.y() * s, axis.z() * s, std::cos(0.5 * angle));
  }
  /** Rotation by fixed axes: roll about x, then pitch about y, then yaw about z [rad]. */
  void setRPY(const tf2Scalar& roll, const tf2Scalar& pitch, const tf2Scalar& yaw) {
    const tf2Scalar cr = std::cos(0.5 * roll), sr = std::sin(0.5 * roll), cp = std::cos(0.5 * pitch),
                    sp = std::sin(0.5 * pitch), cy = std::cos(0.5 * yaw), sy = std::sin(0.5 * yaw);
    *this = Quaternion(sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
                       cr * cp * cy + sr * sp * sy);
  }
  void setEulerZYX(const tf2Scalar& yaw, const tf2Scalar& pitch, const tf2Scalar& roll) { setRPY(roll, pitch, yaw); }
  /** Yaw about y, pitch about x, roll about z, as in Bullet [rad]. */
  void setEuler(const tf2Scalar& yaw, const tf2Scalar& pitch, const tf2Scalar& roll) {
    *this =
        Quaternion(Vector3(0, 1, 0), yaw) * Quaternion(Vector3(1, 0, 0), pitch) * Quaternion(Vector3(0, 0, 1), roll);
  }

  tf2Scalar dot(const Quaternion& q) const { return x() * q.x() + y() * q.y() + z() * q.z() + w() * q.w(); }
  tf2Scalar length2() const { return dot(*this); }
  tf2Scalar length() const { return std::sqrt(length2()); }
  Quaternion& normalize() { return *this /= length(); }
  Quaternion normalized() const { return *this / length(); }
  Quaternion inverse() const { return Quaternion(-x(), -y(), -z(), w()); }
  /** Angle of the rotation [rad]. */
  tf2Scalar getAngle() const { return 2.0 * std::acos(clamped(w())); }
  tf2Scalar getAngleShortestPath() const { return 2.0 * std::acos(clamped(std::fabs(w()))); }
  Vector3 getAxis() const {
    const tf2Scalar s2 = 1.0 - w() * w();
    if (s2 < 10.0 * TF2SIMD_EPSILON) return Vector3(1.0, 0.0, 0.0);
    const tf2Scalar s = std::sqrt(s2);
    return Vector3(x() / s, y() / s, z() / s);
  }
  tf2Scalar angle(const Quaternion& q) const { return std::acos(clamped(dot(q) / std::sqrt(length2() * q.length2()))); }
  /** Angle to another rotation along the shorter way [rad]. */
  tf2Scalar angleShortestPath(const Quaternion& q) const {
    return 2.0 * std::acos(clamped(std::fabs(dot(q)) / std::sqrt(length2() * q.length2())));
  }
  Quaternion slerp(const Quaternion& q, const tf2Scalar& t) const {
    const tf2Scalar sign = dot(q) < 0.0 ? -1.0 : 1.0;
    const tf2Scalar theta = std::acos(clamped(sign * dot(q) / std::sqrt(length2() * q.length2())));
    if (theta < 1e-9) return *this;
    const tf2Scalar a = std::sin((1.0 - t) * theta) / std::sin(theta), b = sign * std::sin(t * theta) / std::sin(theta);
    return *this * a + q * b;
  }
  static const Quaternion& getIdentity() {
    static const Quaternion identity;
    return identity;
  }

  Quaternion operator*(const tf2Scalar& s) const { return Quaternion(x() * s, y() * s, z() * s, w() * s); }
  Quaternion operator/(const tf2Scalar& s) const { return *this * (1.0 / s); }
  Quaternion& operator*=(const tf2Scalar& s) { return *this = *this * s; }
  Quaternion& operator/=(const tf2Scalar& s) { return *this = *this / s; }
  Quaternion& operator*=(const Quaternion& q) { return *this = *this * q; }
  Quaternion& operator+=(const Quaternion& q) { return *this = *this + q; }
  Quaternion& operator-=(const Quaternion& q) { return *this = *this - q; }
  Quaternion operator+(const Quaternion& q) const {
    return Quaternion(x() + q.x(), y() + q.y(), z() + q.z(), w() + q.w());
  }
  Quaternion operator-(const Quaternion& q) const {
    return Quaternion(x() - q.x(), y() - q.y(), z() - q.z(), w() - q.w());
  }
  Quaternion operator-() const { return Quaternion(-x(), -y(), -z(), -w()); }
  friend Quaternion operator*(const Quaternion& a, const Quaternion& b) {
    return Quaternion(a.w() * b.x() + a.x() * b.w() + a.y() * b.z() - a.z() * b.y(),
                      a.w() * b.y() + a.y() * b.w() + a.z() * b.x() - a.x() * b.z(),
                      a.w() * b.z() + a.z() * b.w() + a.x() * b.y() - a.y() * b.x(),
                      a.w() * b.w() - a.x() * b.x() - a.y() * b.y() - a.z() * b.z());
  }
  bool operator==(const Quaternion& q) const { return x() == q.x() && y() == q.y() && z() == q.z() && w() == q.w(); }
  bool operator!=(const Quaternion& q) const { return !(*this == q); }

 private:
  static tf2Scalar clamped(tf2Scalar c) { return c < -1.0 ? -1.0 : c > 1.0 ? 1.0 : c; }
  tf2Scalar q_[4];
};

/** Rotate a vector. */
inline Vector3 quatRotate(const Quaternion& q, const Vector3& v) {
  const Quaternion r = q * Quaternion(v.x(), v.y(), v.z(), 0.0) * q.inverse();
  return Vector3(r.x(), r.y(), r.z());
}
inline Quaternion inverse(const Quaternion& q) { return q.inverse(); }
inline tf2Scalar dot(const Quaternion& a, const Quaternion& b) { return a.dot(b); }
inline Quaternion slerp(const Quaternion& a, const Quaternion& b, const tf2Scalar& t) { return a.slerp(b, t); }
inline tf2Scalar length(const Quaternion& q) { return q.length(); }

}  // namespace tf2
