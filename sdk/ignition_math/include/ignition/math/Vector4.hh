// Vector of 4 numbers.
#ifndef IGNITION_MATH_VECTOR4_HH_
#define IGNITION_MATH_VECTOR4_HH_

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
class Vector4 {
 public:
  static const Vector4 Zero;
  static const Vector4 One;
  static const Vector4 NaN;
  static const Vector4 UnitX;
  static const Vector4 UnitY;
  static const Vector4 UnitZ;
  static const Vector4 UnitW;

  Vector4() : data{T(0), T(0), T(0), T(0)} {}
  Vector4(const T& x, const T& y, const T& z, const T& w) : data{x, y, z, w} {}

  void Set(T x = 0, T y = 0, T z = 0, T w = 0) {
    data[0] = x;
    data[1] = y;
    data[2] = z;
    data[3] = w;
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
  T W() const { return data[3]; }
  T& W() { return data[3]; }
  void W(const T& value) { data[3] = value; }

  // An index that is too large means the last number.
  T operator[](std::size_t index) const { return data[std::min<std::size_t>(index, 3)]; }
  T& operator[](std::size_t index) { return data[std::min<std::size_t>(index, 3)]; }

  T Sum() const { return data[0] + data[1] + data[2] + data[3]; }
  T Dot(const Vector4& other) const {
    return data[0] * other.data[0] + data[1] * other.data[1] + data[2] * other.data[2] + data[3] * other.data[3];
  }
  T AbsDot(const Vector4& other) const { return Abs().Dot(other.Abs()); }
  T SquaredLength() const { return Dot(*this); }
  T Length() const { return static_cast<T>(std::sqrt(static_cast<double>(SquaredLength()))); }
  T Distance(const Vector4& other) const { return (*this - other).Length(); }
  Vector4 Abs() const { return {std::abs(data[0]), std::abs(data[1]), std::abs(data[2]), std::abs(data[3])}; }
  Vector4 Normalize() {
    const T length = Length();
    if (length != T(0)) *this /= length;
    return *this;
  }
  Vector4 Normalized() const { return Vector4(*this).Normalize(); }
  Vector4 Round() {
    for (T& value : data) value = static_cast<T>(std::nearbyint(value));
    return *this;
  }
  Vector4 Rounded() const { return Vector4(*this).Round(); }
  void Max(const Vector4& other) {
    for (int i = 0; i < 4; ++i) data[i] = std::max(data[i], other.data[i]);
  }
  void Min(const Vector4& other) {
    for (int i = 0; i < 4; ++i) data[i] = std::min(data[i], other.data[i]);
  }
  T Max() const { return *std::max_element(data, data + 4); }
  T Min() const { return *std::min_element(data, data + 4); }
  bool Equal(const Vector4& other, const T& tolerance) const {
    return equal<T>(data[0], other.data[0], tolerance) && equal<T>(data[1], other.data[1], tolerance) &&
           equal<T>(data[2], other.data[2], tolerance) && equal<T>(data[3], other.data[3], tolerance);
  }
  bool IsFinite() const {
    return std::isfinite(static_cast<double>(data[0])) && std::isfinite(static_cast<double>(data[1])) &&
           std::isfinite(static_cast<double>(data[2])) && std::isfinite(static_cast<double>(data[3]));
  }
  void Correct() {
    for (T& value : data)
      if (!std::isfinite(static_cast<double>(value))) value = T(0);
  }
  Vector4 operator+(const Vector4& o) const {
    return {data[0] + o.data[0], data[1] + o.data[1], data[2] + o.data[2], data[3] + o.data[3]};
  }
  Vector4 operator+(T value) const { return {data[0] + value, data[1] + value, data[2] + value, data[3] + value}; }
  const Vector4& operator+=(const Vector4& o) { return *this = *this + o; }
  const Vector4& operator+=(T value) { return *this = *this + value; }
  Vector4 operator-(const Vector4& o) const {
    return {data[0] - o.data[0], data[1] - o.data[1], data[2] - o.data[2], data[3] - o.data[3]};
  }
  Vector4 operator-(T value) const { return {data[0] - value, data[1] - value, data[2] - value, data[3] - value}; }
  const Vector4& operator-=(const Vector4& o) { return *this = *this - o; }
  const Vector4& operator-=(T value) { return *this = *this - value; }
  Vector4 operator*(const Vector4& o) const {
    return {data[0] * o.data[0], data[1] * o.data[1], data[2] * o.data[2], data[3] * o.data[3]};
  }
  Vector4 operator*(T value) const { return {data[0] * value, data[1] * value, data[2] * value, data[3] * value}; }
  const Vector4& operator*=(const Vector4& o) { return *this = *this * o; }
  const Vector4& operator*=(T value) { return *this = *this * value; }
  Vector4 operator/(const Vector4& o) const {
    return {data[0] / o.data[0], data[1] / o.data[1], data[2] / o.data[2], data[3] / o.data[3]};
  }
  Vector4 operator/(T value) const { return {data[0] / value, data[1] / value, data[2] / value, data[3] / value}; }
  const Vector4& operator/=(const Vector4& o) { return *this = *this / o; }
  const Vector4& operator/=(T value) { return *this = *this / value; }
  Vector4 operator-() const { return {-data[0], -data[1], -data[2], -data[3]}; }
  friend Vector4 operator*(T value, const Vector4& vector) { return vector * value; }
  bool operator==(const Vector4& other) const { return Equal(other, T(1e-3)); }
  bool operator!=(const Vector4& other) const { return !(*this == other); }
  bool operator<(const Vector4& o) const {
    return data[0] < o.data[0] && data[1] < o.data[1] && data[2] < o.data[2] && data[3] < o.data[3];
  }

  friend std::ostream& operator<<(std::ostream& out, const Vector4& v) {
    return out << precision(v.data[0], 6) << ' ' << precision(v.data[1], 6) << ' ' << precision(v.data[2], 6) << ' '
               << precision(v.data[3], 6);
  }
  friend std::istream& operator>>(std::istream& in, Vector4& v) {
    return in >> v.data[0] >> v.data[1] >> v.data[2] >> v.data[3];
  }

 private:
  T data[4];
};

template <typename T>
const Vector4<T> Vector4<T>::Zero(0, 0, 0, 0);
template <typename T>
const Vector4<T> Vector4<T>::One(1, 1, 1, 1);
template <typename T>
const Vector4<T> Vector4<T>::NaN(std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::quiet_NaN(),
                                 std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::quiet_NaN());
template <typename T>
const Vector4<T> Vector4<T>::UnitX(1, 0, 0, 0);
template <typename T>
const Vector4<T> Vector4<T>::UnitY(0, 1, 0, 0);
template <typename T>
const Vector4<T> Vector4<T>::UnitZ(0, 0, 1, 0);
template <typename T>
const Vector4<T> Vector4<T>::UnitW(0, 0, 0, 1);

typedef Vector4<int> Vector4i;
typedef Vector4<double> Vector4d;
typedef Vector4<float> Vector4f;

}  // namespace math
}  // namespace ignition

#endif
