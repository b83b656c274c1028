#pragma once

#define TF2_MATRIX3x3_H  // by which programs know that it is included

#include "tf2/LinearMath/Quaternion.h"
#include "tf2/LinearMath/Vector3.h"

namespace tf2 {

/** Matrix of three rows; mostly a rotation. */
class Matrix3x3 {
 public:
  Matrix3x3() {}
  explicit Matrix3x3(const Quaternion& q) { setRotation(q); }
  Matrix3x3(const tf2Scalar& xx, const tf2Scalar& xy, const tf2Scalar& xz, const tf2Scalar& yx, const tf2Scalar& yy,
            const tf2Scalar& yz, const tf2Scalar& zx, const tf2Scalar& zy, const tf2Scalar& zz) {
    setValue(xx, xy, xz, yx, yy, yz, zx, zy, zz);
  }

  void setValue(const tf2Scalar& xx, const tf2Scalar& xy, const tf2Scalar& xz, const tf2Scalar& yx, const tf2Scalar& yy,
                const tf2Scalar& yz, const tf2Scalar& zx, const tf2Scalar& zy, const tf2Scalar& zz) {
    rows_[0] = Vector3(xx, xy, xz);
    rows_[1] = Vector3(yx, yy, yz);
    rows_[2] = Vector3(zx, zy, zz);
  }
  void setIdentity() { setValue(1, 0, 0, 0, 1, 0, 0, 0, 1); }
  static const Matrix3x3& getIdentity() {
    static const Matrix3x3 identity(1, 0, 0, 0, 1, 0, 0, 0, 1);
    return identity;
  }
  void setRotation(const Quaternion& q) {
    const tf2Scalar s = 2.0 / q.length2();
    const tf2Scalar x = q.x(), y = q.y(), z = q.z(), w = q.w();
    setValue(1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), s * (x * y + z * w),
             1.0 - s * (x * x + z * z), s * (y * z - x * w), s * (x * z - y * w), s * (y * z + x * w),
             1.0 - s * (x * x + y * y));
  }
  void getRotation(Quaternion& q) const {
    // By w where the trace is positive, else by the largest of x, y and z: so the sign is tf's.
    const tf2Scalar xx = rows_[0].x(), yy = rows_[1].y(), zz = rows_[2].z(), trace = xx + yy + zz;
    const tf2Scalar a = rows_[2].y() - rows_[1].z(), b = rows_[0].z() - rows_[2].x(), c = rows_[1].x() - rows_[0].y();
    const tf2Scalar d = rows_[0].y() + rows_[1].x(), e = rows_[0].z() + rows_[2].x(), f = rows_[1].z() + rows_[2].y();
    if (trace > 0) q = Quaternion(a, b, c, 1.0 + trace);
    else if (xx >= yy && xx >= zz) q = Quaternion(1.0 + xx - yy - zz, d, e, a);
    else if (yy >= zz) q = Quaternion(d, 1.0 + yy - xx - zz, f, b);
    else q = Quaternion(e, f, 1.0 + zz - xx - yy, c);
    q.normalize();
  }
  void setRPY(tf2Scalar roll, tf2Scalar pitch, tf2Scalar yaw) {
    Quaternion q;
    q.setRPY(roll, pitch, yaw);
    setRotation(q);
  }
  void setEulerYPR(tf2Scalar yaw, tf2Scalar pitch, tf2Scalar roll) { setRPY(roll, pitch, yaw); }
  void setEulerZYX(tf2Scalar roll, tf2Scalar pitch, tf2Scalar yaw) { setRPY(roll, pitch, yaw); }
  /** Angles about fixed axes [rad]; the second solution has the pitch beyond ±π/2. */
  void getRPY(tf2Scalar& roll, tf2Scalar& pitch, tf2Scalar& yaw, unsigned int solution = 1) const {
    getEulerYPR(yaw, pitch, roll, solution);
  }
  void getEulerYPR(tf2Scalar& yaw, tf2Scalar& pitch, tf2Scalar& roll, unsigned int solution = 1) const {
    const tf2Scalar sine = -rows_[2].x();
    if (std::fabs(rows_[2].x()) >= 1.0) {  // gimbal lock: only the difference of yaw and roll is known
      yaw = 0.0;
      pitch = std::copysign(TF2SIMD_HALF_PI, sine);
      roll = sine > 0.0 ? std::atan2(rows_[0].y(), rows_[0].z()) : std::atan2(-rows_[0].y(), -rows_[0].z());
      return;
    }
    const tf2Scalar first = std::asin(sine);
    pitch = solution == 1 ? first : TF2SIMD_PI - first;
    const tf2Scalar sign = solution == 1 ? 1.0 : -1.0;
    roll = std::atan2(sign * rows_[2].y(), sign * rows_[2].z());
    yaw = std::atan2(sign * rows_[1].x(), sign * rows_[0].x());
  }

  Vector3 getColumn(int i) const { return Vector3(rows_[0][i], rows_[1][i], rows_[2][i]); }
  const Vector3& getRow(int i) const { return rows_[i]; }
  Vector3& operator[](int i) { return rows_[i]; }
  const Vector3& operator[](int i) const { return rows_[i]; }
  Matrix3x3 transpose() const {
    Matrix3x3 m;
    for (int i = 0; i < 3; ++i) m.rows_[i] = getColumn(i);
    return m;
  }
  tf2Scalar determinant() const { return rows_[0].triple(rows_[1], rows_[2]); }
  Matrix3x3 inverse() const {
    Matrix3x3 columns;
    for (int i = 0; i < 3; ++i) columns.rows_[i] = rows_[(i + 1) % 3].cross(rows_[(i + 2) % 3]) / determinant();
    return columns.transpose();
  }
  Matrix3x3 scaled(const Vector3& s) const {
    Matrix3x3 m;
    for (int i = 0; i < 3; ++i) m.rows_[i] = rows_[i] * s;
    return m;
  }
  Matrix3x3 transposeTimes(const Matrix3x3& m) const { return transpose() * m; }
  Matrix3x3 timesTranspose(const Matrix3x3& m) const { return *this * m.transpose(); }
  Matrix3x3& operator*=(const Matrix3x3& m) { return *this = *this * m; }
  friend Vector3 operator*(const Matrix3x3& m, const Vector3& v) {
    return Vector3(m.rows_[0].dot(v), m.rows_[1].dot(v), m.rows_[2].dot(v));
  }
  friend Vector3 operator*(const Vector3& v, const Matrix3x3& m) { return m.transpose() * v; }
  friend Matrix3x3 operator*(const Matrix3x3& a, const Matrix3x3& b) {
    const Matrix3x3 columns = b.transpose();
    Matrix3x3 m;
    for (int i = 0; i < 3; ++i) m.rows_[i] = columns * a.rows_[i];
    return m;
  }
  bool operator==(const Matrix3x3& m) const {
    return rows_[0] == m.rows_[0] && rows_[1] == m.rows_[1] && rows_[2] == m.rows_[2];
  }

 private:
  Vector3 rows_[3];
};

}  // namespace tf2
