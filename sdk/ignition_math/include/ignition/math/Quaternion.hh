// Rotation as a unit quaternion; Euler angles are roll, pitch and yaw about fixed axes.
#ifndef IGNITION_MATH_QUATERNION_HH_
#define IGNITION_MATH_QUATERNION_HH_

#include <ignition/math/Angle.hh>
#include <ignition/math/Vector3.hh>

namespace ignition {
namespace math {

template <typename T>
class Matrix3;

template <typename T>
class Quaternion {
 public:
  static const Quaternion Identity, Zero;

  Quaternion() : qw(1), qx(0), qy(0), qz(0) {}
  Quaternion(const T& w, const T& x, const T& y, const T& z) : qw(w), qx(x), qy(y), qz(z) {}
  Quaternion(const T& roll, const T& pitch, const T& yaw) { Euler(roll, pitch, yaw); }
  Quaternion(const Vector3<T>& axis, const T& angle) { Axis(axis, angle); }
  explicit Quaternion(const Vector3<T>& rpy) { Euler(rpy); }
  explicit Quaternion(const Matrix3<T>& matrix) { Matrix(matrix); }

  T W() const { return qw; }
  T X() const { return qx; }
  T Y() const { return qy; }
  T Z() const { return qz; }
  T& W() { return qw; }
  T& X() { return qx; }
  T& Y() { return qy; }
  T& Z() { return qz; }
  void W(T value) { qw = value; }
  void X(T value) { qx = value; }
  void Y(T value) { qy = value; }
  void Z(T value) { qz = value; }

  void Set(T w, T x, T y, T z) { *this = Quaternion(w, x, y, z); }
  bool IsFinite() const { return std::isfinite(qw) && std::isfinite(qx) && std::isfinite(qy) && std::isfinite(qz); }
  void Correct() {
    if (!IsFinite() || equal<T>(Dot(*this), T(0), T(1e-12))) *this = Quaternion();
  }
  T Dot(const Quaternion& o) const { return qw * o.qw + qx * o.qx + qy * o.qy + qz * o.qz; }

  void Normalize() {
    const T length = std::sqrt(Dot(*this));
    *this = length > T(1e-12) ? Quaternion(qw / length, qx / length, qy / length, qz / length) : Quaternion();
  }
  Quaternion Normalized() const {
    Quaternion result = *this;
    result.Normalize();
    return result;
  }
  void Invert() { *this = Inverse(); }
  Quaternion Inverse() const {
    const T square = Dot(*this);
    return square > T(0) ? Quaternion(qw / square, -qx / square, -qy / square, -qz / square) : Quaternion();
  }
  Quaternion Exp() const {
    const T angle = std::sqrt(qx * qx + qy * qy + qz * qz), s = angle > T(1e-9) ? std::sin(angle) / angle : T(1);
    return {std::cos(angle), s * qx, s * qy, s * qz};
  }
  Quaternion Log() const {
    const T sine = std::sqrt(qx * qx + qy * qy + qz * qz), s = sine > T(1e-9) ? std::atan2(sine, qw) / sine : T(1);
    return {T(0), s * qx, s * qy, s * qz};
  }

  void Axis(T ax, T ay, T az, T angle) { Axis(Vector3<T>(ax, ay, az), angle); }
  void Axis(const Vector3<T>& axis, T angle) {
    const Vector3<T> unit = axis.Normalized();
    const T s = std::sin(angle / 2);
    *this = unit.SquaredLength() > T(0) ? Quaternion(std::cos(angle / 2), unit.X() * s, unit.Y() * s, unit.Z() * s)
                                        : Quaternion();
  }
  void SetFromAxisAngle(const Vector3<T>& axis, T angle) { Axis(axis, angle); }
  void ToAxis(Vector3<T>& axis, T& angle) const {
    const T length = std::sqrt(qx * qx + qy * qy + qz * qz);
    if (length < T(1e-9)) {
      axis = Vector3<T>::UnitX;
      angle = 0;
    } else {
      axis = Vector3<T>(qx / length, qy / length, qz / length);
      angle = 2 * std::atan2(length, qw);
    }
  }

  void Euler(const Vector3<T>& rpy) { Euler(rpy.X(), rpy.Y(), rpy.Z()); }
  void Euler(T roll, T pitch, T yaw) {
    const T cr = std::cos(roll / 2), sr = std::sin(roll / 2), cp = std::cos(pitch / 2), sp = std::sin(pitch / 2);
    const T cy = std::cos(yaw / 2), sy = std::sin(yaw / 2);
    *this = Quaternion(cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
                       cr * cp * sy - sr * sp * cy);
  }
  void SetFromEuler(const Vector3<T>& rpy) { Euler(rpy); }
  void SetFromEuler(T roll, T pitch, T yaw) { Euler(roll, pitch, yaw); }
  static Quaternion EulerToQuaternion(const Vector3<T>& rpy) { return Quaternion(rpy); }
  static Quaternion EulerToQuaternion(T roll, T pitch, T yaw) { return {roll, pitch, yaw}; }
  Vector3<T> Euler() const { return {Roll(), Pitch(), Yaw()}; }
  T Roll() const {
    const Quaternion q = Normalized();
    return IsVertical(q) ? T(0) : std::atan2(2 * (q.qy * q.qz + q.qw * q.qx), 1 - 2 * (q.qx * q.qx + q.qy * q.qy));
  }
  T Pitch() const {
    const Quaternion q = Normalized();
    return std::asin(clamp<T>(2 * (q.qw * q.qy - q.qx * q.qz), T(-1), T(1)));
  }
  T Yaw() const {
    const Quaternion q = Normalized();
    if (IsVertical(q)) return std::atan2(2 * (q.qw * q.qz - q.qx * q.qy), 1 - 2 * (q.qx * q.qx + q.qz * q.qz));
    return std::atan2(2 * (q.qx * q.qy + q.qw * q.qz), 1 - 2 * (q.qy * q.qy + q.qz * q.qz));
  }

  void Matrix(const Matrix3<T>& m);

  Vector3<T> RotateVector(const Vector3<T>& v) const { return *this * v; }
  Vector3<T> RotateVectorReverse(const Vector3<T>& v) const { return Inverse() * v; }
  Vector3<T> XAxis() const { return *this * Vector3<T>(1, 0, 0); }
  Vector3<T> YAxis() const { return *this * Vector3<T>(0, 1, 0); }
  Vector3<T> ZAxis() const { return *this * Vector3<T>(0, 0, 1); }
  void Round(int digits) {
    qw = precision(qw, digits);
    qx = precision(qx, digits);
    qy = precision(qy, digits);
    qz = precision(qz, digits);
  }
  Quaternion Integrate(const Vector3<T>& angular_velocity, T dt) const {
    const T speed = angular_velocity.Length();
    return speed > T(0) ? Quaternion(angular_velocity, speed * dt) * *this : *this;
  }
  static Quaternion Slerp(T t, const Quaternion& from, const Quaternion& to, bool shortest = false) {
    T cosine = from.Dot(to);
    const Quaternion end = shortest && cosine < 0 ? -to : to;
    if (shortest) cosine = std::abs(cosine);
    if (std::abs(cosine) > T(0.9999)) return (from * (1 - t) + end * t).Normalized();
    const T angle = std::acos(clamp<T>(cosine, T(-1), T(1))), sine = std::sin(angle);
    return from * (std::sin((1 - t) * angle) / sine) + end * (std::sin(t * angle) / sine);
  }

  Quaternion operator+(const Quaternion& o) const { return {qw + o.qw, qx + o.qx, qy + o.qy, qz + o.qz}; }
  Quaternion operator-(const Quaternion& o) const { return {qw - o.qw, qx - o.qx, qy - o.qy, qz - o.qz}; }
  Quaternion operator-() const { return {-qw, -qx, -qy, -qz}; }
  Quaternion operator*(const T& value) const { return {qw * value, qx * value, qy * value, qz * value}; }
  Quaternion operator*(const Quaternion& o) const {
    return {qw * o.qw - qx * o.qx - qy * o.qy - qz * o.qz, qw * o.qx + qx * o.qw + qy * o.qz - qz * o.qy,
            qw * o.qy - qx * o.qz + qy * o.qw + qz * o.qx, qw * o.qz + qx * o.qy - qy * o.qx + qz * o.qw};
  }
  Vector3<T> operator*(const Vector3<T>& v) const {
    const Vector3<T> u(qx, qy, qz), t = u.Cross(v) * T(2);
    return v + t * qw + u.Cross(t);
  }
  Quaternion operator*=(const Quaternion& o) { return *this = *this * o; }
  Quaternion operator+=(const Quaternion& o) { return *this = *this + o; }
  Quaternion operator-=(const Quaternion& o) { return *this = *this - o; }
  bool Equal(const Quaternion& o, const T& tolerance) const {
    return equal(qw, o.qw, tolerance) && equal(qx, o.qx, tolerance) && equal(qy, o.qy, tolerance) &&
           equal(qz, o.qz, tolerance);
  }
  bool operator==(const Quaternion& o) const { return Equal(o, T(0.001)); }
  bool operator!=(const Quaternion& o) const { return !(*this == o); }

  friend std::ostream& operator<<(std::ostream& out, const Quaternion& q) { return out << q.Euler(); }
  friend std::istream& operator>>(std::istream& in, Quaternion& q) {
    Vector3<T> rpy;
    if (in >> rpy) q.Euler(rpy);
    return in;
  }

 private:
  static bool IsVertical(const Quaternion& q) { return std::abs(2 * (q.qw * q.qy - q.qx * q.qz)) > T(1 - 1e-12); }

  T qw, qx, qy, qz;
};

template <typename T>
const Quaternion<T> Quaternion<T>::Identity(1, 0, 0, 0);
template <typename T>
const Quaternion<T> Quaternion<T>::Zero(0, 0, 0, 0);

typedef Quaternion<double> Quaterniond;
typedef Quaternion<float> Quaternionf;
typedef Quaternion<int> Quaternioni;

}  // namespace math
}  // namespace ignition

#include <ignition/math/Matrix3.hh>

#endif
