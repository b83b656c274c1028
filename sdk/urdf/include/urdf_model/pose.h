#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "urdf_exception/exception.h"

namespace urdf {

class Vector3 {
 public:
  Vector3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
  Vector3() : Vector3(0, 0, 0) {}
  double x, y, z;
  void clear() { *this = Vector3(); }
  /** Set from three numbers; throws ParseError. */
  void init(const std::string& text);
  Vector3 operator+(const Vector3& v) const { return Vector3(x + v.x, y + v.y, z + v.z); }
};

class Rotation {
 public:
  Rotation(double x_, double y_, double z_, double w_) : x(x_), y(y_), z(z_), w(w_) {}
  Rotation() : Rotation(0, 0, 0, 1) {}
  double x, y, z, w;
  void clear() { *this = Rotation(); }
  void getQuaternion(double& qx, double& qy, double& qz, double& qw) const {
    qx = x;
    qy = y;
    qz = z;
    qw = w;
  }
  /** Angles about fixed axes [rad]. */
  void getRPY(double& roll, double& pitch, double& yaw) const {
    roll = std::atan2(2 * (y * z + w * x), w * w - x * x - y * y + z * z);
    pitch = std::asin(std::fmax(-1.0, std::fmin(1.0, -2 * (x * z - w * y))));
    yaw = std::atan2(2 * (x * y + w * z), w * w + x * x - y * y - z * z);
  }
  void setFromQuaternion(double qx, double qy, double qz, double qw) {
    *this = Rotation(qx, qy, qz, qw);
    normalize();
  }
  void setFromRPY(double roll, double pitch, double yaw) {
    const double cr = std::cos(roll / 2), sr = std::sin(roll / 2), cp = std::cos(pitch / 2), sp = std::sin(pitch / 2),
                 cy = std::cos(yaw / 2), sy = std::sin(yaw / 2);
    *this = Rotation(sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
                     cr * cp * cy + sr * sp * sy);
    normalize();
  }
  void init(const std::string& rpy);
  void normalize() {
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    *this = length > 1e-5 ? Rotation(x / length, y / length, z / length, w / length) : Rotation();
  }
  Rotation operator*(const Rotation& q) const {
    return Rotation(w * q.x + x * q.w + y * q.z - z * q.y, w * q.y - x * q.z + y * q.w + z * q.x,
                    w * q.z + x * q.y - y * q.x + z * q.w, w * q.w - x * q.x - y * q.y - z * q.z);
  }
  Vector3 operator*(const Vector3& v) const {
    const Rotation r = *this * Rotation(v.x, v.y, v.z, 0) * GetInverse();
    return Vector3(r.x, r.y, r.z);
  }
  Rotation GetInverse() const { return Rotation(-x, -y, -z, w); }
};

class Pose {
 public:
  Vector3 position;
  Rotation rotation;
  void clear() { *this = Pose(); }
};

}  // namespace urdf
