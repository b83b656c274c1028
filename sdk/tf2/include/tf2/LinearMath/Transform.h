#pragma once

#include "tf2/LinearMath/Matrix3x3.h"

namespace tf2 {

/** Rotation and translation. */
class Transform {
 public:
  Transform() {}
  explicit Transform(const Quaternion& q, const Vector3& c = Vector3()) : basis_(q), origin_(c) {}
  explicit Transform(const Matrix3x3& b, const Vector3& c = Vector3()) : basis_(b), origin_(c) {}

  Vector3 operator()(const Vector3& v) const { return basis_ * v + origin_; }
  Vector3 operator*(const Vector3& v) const { return (*this)(v); }
  Quaternion operator*(const Quaternion& q) const { return getRotation() * q; }
  Transform operator*(const Transform& t) const { return Transform(basis_ * t.basis_, (*this)(t.origin_)); }
  Transform& operator*=(const Transform& t) { return *this = *this * t; }
  void mult(const Transform& a, const Transform& b) { *this = a * b; }
  Transform inverse() const {
    const Matrix3x3 back = basis_.transpose();
    return Transform(back, back * -origin_);
  }
  Transform inverseTimes(const Transform& t) const { return inverse() * t; }
  Vector3 invXform(const Vector3& v) const { return basis_.transpose() * (v - origin_); }

  Matrix3x3& getBasis() { return basis_; }
  const Matrix3x3& getBasis() const { return basis_; }
  Vector3& getOrigin() { return origin_; }
  const Vector3& getOrigin() const { return origin_; }
  Quaternion getRotation() const {
    Quaternion q;
    basis_.getRotation(q);
    return q;
  }
  void setBasis(const Matrix3x3& b) { basis_ = b; }
  void setOrigin(const Vector3& v) { origin_ = v; }
  void setRotation(const Quaternion& q) { basis_.setRotation(q); }
  void setIdentity() { *this = getIdentity(); }
  static const Transform& getIdentity() {
    static const Transform identity(Matrix3x3::getIdentity());
    return identity;
  }
  bool operator==(const Transform& t) const { return basis_ == t.basis_ && origin_ == t.origin_; }

 private:
  Matrix3x3 basis_;
  Vector3 origin_;
};

}  // namespace tf2
