// Vector of 3 numbers.
#ifndef IGNITION_MATH_VECTOR3_HH_
#define IGNITION_MATH_VECTOR3_HH_

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <istream>
#include <limits>
#include <ostream>

#include <ignition/math/Helpers.hh>

namespace ignition {
namespace math {

template <typename T>
class Vector3 {
 public:
  static const Vector3 Zero;
  static const Vector3 One;
  static const Vector3 NaN;
  static const Vector3 UnitX;
  static const Vector3 UnitY;
  static const Vector3 UnitZ;

  Vector3() : data{T(0), T(0), T(0)} {}
  Vector3(const T& x, const T& y, const T& z) : data{x, y, z} {}

  // All three.
  Vector3& operator=(T value) {
    data[0] = data[1] = data[2] = value;
    return *this;
  }
  void Set(T x = 0, T y = 0, T z = 0) {
    data[0] = x;
    data[1] = y;
    data[2] = z;
  }
  T X() const { return data[0]; }
  T& X() { return data[0]; }
  void X(const T& value) { data[0] = value; }
  T Y() const { return data[1]; }
  T& Y() { return data[1]; }
  void Y(const T& value) { data[1] = value; }
  T Z() const { return data[2]; }
  T& Z() { return data[2]; }
  void Z(const T& value) { data[2] = value; }

  // An index that is too large means the last number.
  T operator[](std::size_t index) const { return data[std::min<std::size_t>(index, 2)]; }
  T& operator[](std::size_t index) { return data[std::min<std::size_t>(index, 2)]; }

  T Sum() const { return data[0] + data[1] + data[2]; }
  T Dot(const Vector3& other) const {
    return data[0] * other.data[0] + data[1] * other.data[1] + data[2] * other.data[2];
  }
  T AbsDot(const Vector3& other) const { return Abs().Dot(other.Abs()); }
  T SquaredLength() const { return Dot(*this); }
  T Length() const { return static_cast<T>(std::sqrt(static_cast<double>(SquaredLength()))); }
  T Distance(const Vector3& other) const { return (*this - other).Length(); }
  Vector3 Abs() const { return {std::abs(data[0]), std::abs(data[1]), std::abs(data[2])}; }
  Vector3 Normalize() {
    const T length = Length();
    if (length != T(0)) *this /= length;
    return *this;
  }
  Vector3 Normalized() const { return Vector3(*this).Normalize(); }
  Vector3 Round() {
    for (T& value : data) value = static_cast<T>(std::nearbyint(value));
    return *this;
  }
  Vector3 Rounded() const { return Vector3(*this).Round(); }
  void Max(const Vector3& other) {
    for (int i = 0; i < 3; ++i) data[i] = std::max(data[i], other.data[i]);
  }
  void Min(const Vector3& other) {
    for (int i = 0; i < 3; ++i) data[i] = std::min(data[i], other.data[i]);
  }
  T Max() const { return *std::max_element(data, data + 3); }
  T Min() const { return *std::min_element(data, data + 3); }
  bool Equal(const Vector3& other, const T& tolerance) const {
    return equal<T>(data[0], other.data[0], tolerance) && equal<T>(data[1], other.data[1], tolerance) &&
           equal<T>(data[2], other.data[2], tolerance);
  }
  bool IsFinite() const {
    return std::isfinite(static_cast<double>(data[0])) && std::isfinite(static_cast<double>(data[1])) &&
           std::isfinite(static_cast<double>(data[2]));
  }
  void Correct() {
    for (T& value : data)
      if (!std::isfinite(static_cast<double>(value))) value = T(0);
  }

  Vector3 Cross(const Vector3& o) const {
    return {data[1] * o.data[2] - data[2] * o.data[1], data[2] * o.data[0] - data[0] * o.data[2],
            data[0] * o.data[1] - data[1] * o.data[0]};
  }
  Vector3 Perpendicular() const {
    const Vector3 first = Cross(UnitX);
    return (first.SquaredLength() < T(1e-12) ? Cross(UnitY) : first).Normalized();
  }
  static Vector3 Normal(const Vector3& a, const Vector3& b, const Vector3& c) {
    return (b - a).Cross(c - a).Normalized();
  }
  T DistToLine(const Vector3& a, const Vector3& b) const {
    return (*this - a).Cross(*this - b).Length() / (b - a).Length();
  }
  Vector3 operator+(const Vector3& o) const { return {data[0] + o.data[0], data[1] + o.data[1], data[2] + o.data[2]}; }
  Vector3 operator+(T value) const { return {data[0] + value, data[1] + value, data[2] + value}; }
  const Vector3& operator+=(const Vector3& o) { return *this = *this + o; }
  const Vector3& operator+=(T value) { return *this = *this + value; }
  Vector3 operator-(const Vector3& o) const { return {data[0] - o.data[0], data[1] - o.data[1], data[2] - o.data[2]}; }
  Vector3 operator-(T value) const { return {data[0] - value, data[1] - value, data[2] - value}; }
  const Vector3& operator-=(const Vector3& o) { return *this = *this - o; }
  const Vector3& operator-=(T value) { return *this = *this - value; }
  Vector3 operator*(const Vector3& o) const { return {data[0] * o.data[0], data[1] * o.data[1], data[2] * o.data[2]}; }
  Vector3 operator*(T value) const { return {data[0] * value, data[1] * value, data[2] * value}; }
  const Vector3& operator*=(const Vector3& o) { return *this = *this * o; }
  const Vector3& operator*=(T value) { return *this = *this * value; }
  Vector3 operator/(const Vector3& o) const { return {data[0] / o.data[0], data[1] / o.data[1], data[2] / o.data[2]}; }
  Vector3 operator/(T value) const { return {data[0] / value, data[1] / value, data[2] / value}; }
  const Vector3& operator/=(const Vector3& o) { return *this = *this / o; }
  const Vector3& operator/=(T value) { return *this = *this / value; }
  Vector3 operator-() const { return {-data[0], -data[1], -data[2]}; }
  friend Vector3 operator*(T value, const Vector3& vector) { return vector * value; }
  bool operator==(const Vector3& other) const { return Equal(other, T(1e-3)); }
  bool operator!=(const Vector3& other) const { return !(*this == other); }
  bool operator<(const Vector3& o) const { return data[0] < o.data[0] && data[1] < o.data[1] && data[2] < o.data[2]; }

  friend std::ostream& operator<<(std::ostream& out, const Vector3& v) {
    return out << precision(v.data[0], 6) << ' ' << precision(v.data[1], 6) << ' ' << precision(v.data[2], 6);
  }
  friend std::istream& operator>>(std::istream& in, Vector3& v) { return in >> v.data[0] >> v.data[1] >> v.data[2]; }

 private:
  T data[3];
};

template <typename T>
const Vector3<T> Vector3<T>::Zero(0, 0, 0);
template <typename T>
const Vector3<T> Vector3<T>::One(1, 1, 1);
template <typename T>
const Vector3<T> Vector3<T>::NaN(std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::quiet_NaN(),
                                 std::numeric_limits<T>::quiet_NaN());
template <typename T>
const Vector3<T> Vector3<T>::UnitX(1, 0, 0);
template <typename T>
const Vector3<T> Vector3<T>::UnitY(0, 1, 0);
template <typename T>
const Vector3<T> Vector3<T>::UnitZ(0, 0, 1);

typedef Vector3<int> Vector3i;
typedef Vector3<double> Vector3d;
typedef Vector3<float> Vector3f;

}  // namespace math
}  // namespace ignition

#endif
