#pragma once

#include "tf2/LinearMath/Scalar.h"

namespace tf2 {

/** Vector of three numbers; the fourth is padding, as in the original. */
class Vector3 {
 public:
  tf2Scalar m_floats[4];

  Vector3() : m_floats{0.0, 0.0, 0.0, 0.0} {}
  Vector3(const tf2Scalar& x, const tf2Scalar& y, const tf2Scalar& z) : m_floats{x, y, z, 0.0} {}

  const tf2Scalar& getX() const { return m_floats[0]; }
  const tf2Scalar& getY() const { return m_floats[1]; }
  const tf2Scalar& getZ() const { return m_floats[2]; }
  const tf2Scalar& x() const { return m_floats[0]; }
  const tf2Scalar& y() const { return m_floats[1]; }
  const tf2Scalar& z() const { return m_floats[2]; }
  const tf2Scalar& w() const { return m_floats[3]; }
  void setX(tf2Scalar x) { m_floats[0] = x; }
  void setY(tf2Scalar y) { m_floats[1] = y; }
  void setZ(tf2Scalar z) { m_floats[2] = z; }
  void setW(tf2Scalar w) { m_floats[3] = w; }
  void setValue(const tf2Scalar& x, const tf2Scalar& y, const tf2Scalar& z) { *this = Vector3(x, y, z); }
  void setZero() { *this = Vector3(); }
  bool isZero() const { return x() == 0.0 && y() == 0.0 && z() == 0.0; }
  operator tf2Scalar*() { return m_floats; }
  operator const tf2Scalar*() const { return m_floats; }

  tf2Scalar dot(const Vector3& v) const { return x() * v.x() + y() * v.y() + z() * v.z(); }
  Vector3 cross(const Vector3& v) const {
    return Vector3(y() * v.z() - z() * v.y(), z() * v.x() - x() * v.z(), x() * v.y() - y() * v.x());
  }
  tf2Scalar triple(const Vector3& a, const Vector3& b) const { return dot(a.cross(b)); }
  tf2Scalar length2() const { return dot(*this); }
  tf2Scalar length() const { return std::sqrt(length2()); }
  tf2Scalar distance2(const Vector3& v) const { return (v - *this).length2(); }
  tf2Scalar distance(const Vector3& v) const { return (v - *this).length(); }
  /** Angle to another vector [rad]. */
  tf2Scalar angle(const Vector3& v) const {
    const tf2Scalar cosine = dot(v) / std::sqrt(length2() * v.length2());
    return std::acos(cosine < -1.0 ? -1.0 : cosine > 1.0 ? 1.0 : cosine);
  }
  Vector3& normalize() { return *this /= length(); }
  Vector3 normalized() const { return *this / length(); }
  Vector3 absolute() const { return Vector3(std::fabs(x()), std::fabs(y()), std::fabs(z())); }
  Vector3 lerp(const Vector3& v, const tf2Scalar& t) const { return *this + (v - *this) * t; }
  void setInterpolate3(const Vector3& a, const Vector3& b, tf2Scalar t) { *this = a.lerp(b, t); }
  /** Rotate about a unit axis by an angle [rad]. */
  Vector3 rotate(const Vector3& axis, const tf2Scalar angle) const {
    const Vector3 along = axis * axis.dot(*this), across = *this - along;
    return along + across * std::cos(angle) + axis.cross(*this) * std::sin(angle);
  }

  Vector3& operator+=(const Vector3& v) { return *this = *this + v; }
  Vector3& operator-=(const Vector3& v) { return *this = *this - v; }
  Vector3& operator*=(const tf2Scalar& s) { return *this = *this * s; }
  Vector3& operator*=(const Vector3& v) { return *this = *this * v; }
  Vector3& operator/=(const tf2Scalar& s) { return *this = *this / s; }
  friend Vector3 operator+(const Vector3& a, const Vector3& b) {
    return Vector3(a.x() + b.x(), a.y() + b.y(), a.z() + b.z());
  }
  friend Vector3 operator-(const Vector3& a, const Vector3& b) {
    return Vector3(a.x() - b.x(), a.y() - b.y(), a.z() - b.z());
  }
  friend Vector3 operator*(const Vector3& a, const Vector3& b) {
    return Vector3(a.x() * b.x(), a.y() * b.y(), a.z() * b.z());
  }
  friend Vector3 operator-(const Vector3& v) { return Vector3(-v.x(), -v.y(), -v.z()); }
  friend Vector3 operator*(const Vector3& v, const tf2Scalar& s) { return Vector3(v.x() * s, v.y() * s, v.z() * s); }
  friend Vector3 operator*(const tf2Scalar& s, const Vector3& v) { return v * s; }
  friend Vector3 operator/(const Vector3& v, const tf2Scalar& s) { return v * (1.0 / s); }
  bool operator==(const Vector3& v) const { return x() == v.x() && y() == v.y() && z() == v.z(); }
  bool operator!=(const Vector3& v) const { return !(*this == v); }
};

inline tf2Scalar tf2Dot(const Vector3& a, const Vector3& b) { return a.dot(b); }
inline Vector3 tf2Cross(const Vector3& a, const Vector3& b) { return a.cross(b); }
inline tf2Scalar tf2Distance(const Vector3& a, const Vector3& b) { return a.distance(b); }
inline tf2Scalar tf2Angle(const Vector3& a, const Vector3& b) { return a.angle(b); }

}  // namespace tf2
