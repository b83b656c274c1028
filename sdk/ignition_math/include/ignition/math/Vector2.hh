// Vector of 2 numbers.
#ifndef IGNITION_MATH_VECTOR2_HH_
#define IGNITION_MATH_VECTOR2_HH_

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
class Vector2 {
 public:
  static const Vector2 Zero;
  static const Vector2 One;
  static const Vector2 NaN;
  static const Vector2 UnitX;
  static const Vector2 UnitY;

  Vector2() : data{T(0), T(0)} {}
  Vector2(const T& x, const T& y) : data{x, y} {}

  void Set(T x = 0, T y = 0) {
    data[0] = x;
    data[1] = y;
  }
  T X() const { return data[0]; }
  T& X() { return data[0]; }
  void X(const T& value) { data[0] = value; }
  T Y() const { return data[1]; }
  T& Y() { return data[1]; }
  void Y(const T& value) { data[1] = value; }

  // An index that is too large means the last number.
  T operator[](std::size_t index) const { return data[std::min<std::size_t>(index, 1)]; }
  T& operator[](std::size_t index) { return data[std::min<std::size_t>(index, 1)]; }

  T Sum() const { return data[0] + data[1]; }
  T Dot(const Vector2& other) const { return data[0] * other.data[0] + data[1] * other.data[1]; }
  T AbsDot(const Vector2& other) const { return Abs().Dot(other.Abs()); }
  T SquaredLength() const { return Dot(*this); }
  T Length() const { return static_cast<T>(std::sqrt(static_cast<double>(SquaredLength()))); }
  T Distance(const Vector2& other) const { return (*this - other).Length(); }
  Vector2 Abs() const { return {std::abs(data[0]), std::abs(data[1])}; }
  Vector2 Normalize() {
    const T length = Length();
    if (length != T(0)) *this /= length;
    return *this;
  }
  Vector2 Normalized() const { return Vector2(*this).Normalize(); }
  Vector2 Round() {
    for (T& value : data) value = static_cast<T>(std::nearbyint(value));
    return *this;
  }
  Vector2 Rounded() const { return Vector2(*this).Round(); }
  void Max(const Vector2& other) {
    for (int i = 0; i < 2; ++i) data[i] = std::max(data[i], other.data[i]);
  }
  void Min(const Vector2& other) {
    for (int i = 0; i < 2; ++i) data[i] = std::min(data[i], other.data[i]);
  }
  T Max() const { return *std::max_element(data, data + 2); }
  T Min() const { return *std::min_element(data, data + 2); }
  bool Equal(const Vector2& other, const T& tolerance) const {
    return equal<T>(data[0], other.data[0], tolerance) && equal<T>(data[1], other.data[1], tolerance);
  }
  bool IsFinite() const {
    return std::isfinite(static_cast<double>(data[0])) && std::isfinite(static_cast<double>(data[1]));
  }
  void Correct() {
    for (T& value : data)
      if (!std::isfinite(static_cast<double>(value))) value = T(0);
  }
  Vector2 operator+(const Vector2& o) const { return {data[0] + o.data[0], data[1] + o.data[1]}; }
  Vector2 operator+(T value) const { return {data[0] + value, data[1] + value}; }
  const Vector2& operator+=(const Vector2& o) { return *this = *this + o; }
  const Vector2& operator+=(T value) { return *this = *this + value; }
  Vector2 operator-(const Vector2& o) const { return {data[0] - o.data[0], data[1] - o.data[1]}; }
  Vector2 operator-(T value) const { return {data[0] - value, data[1] - value}; }
  const Vector2& operator-=(const Vector2& o) { return *this = *this - o; }
  const Vector2& operator-=(T value) { return *this = *this - value; }
  Vector2 operator*(const Vector2& o) const { return {data[0] * o.data[0], data[1] * o.data[1]}; }
  Vector2 operator*(T value) const { return {data[0] * value, data[1] * value}; }
  const Vector2& operator*=(const Vector2& o) { return *this = *this * o; }
  const Vector2& operator*=(T value) { return *this = *this * value; }
  Vector2 operator/(const Vector2& o) const { return {data[0] / o.data[0], data[1] / o.data[1]}; }
  Vector2 operator/(T value) const { return {data[0] / value, data[1] / value}; }
  const Vector2& operator/=(const Vector2& o) { return *this = *this / o; }
  const Vector2& operator/=(T value) { return *this = *this / value; }
  Vector2 operator-() const { return {-data[0], -data[1]}; }
  friend Vector2 operator*(T value, const Vector2& vector) { return vector * value; }
  bool operator==(const Vector2& other) const { return Equal(other, T(1e-3)); }
  bool operator!=(const Vector2& other) const { return !(*this == other); }
  bool operator<(const Vector2& o) const { return data[0] < o.data[0] && data[1] < o.data[1]; }

  friend std::ostream& operator<<(std::ostream& out, const Vector2& v) {
    return out << precision(v.data[0], 6) << ' ' << precision(v.data[1], 6);
  }
  friend std::istream& operator>>(std::istream& in, Vector2& v) { return in >> v.data[0] >> v.data[1]; }

 private:
  T data[2];
};

template <typename T>
const Vector2<T> Vector2<T>::Zero(0, 0);
template <typename T>
const Vector2<T> Vector2<T>::One(1, 1);
template <typename T>
const Vector2<T> Vector2<T>::NaN(std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::quiet_NaN());
template <typename T>
const Vector2<T> Vector2<T>::UnitX(1, 0);
template <typename T>
const Vector2<T> Vector2<T>::UnitY(0, 1);

typedef Vector2<int> Vector2i;
typedef Vector2<double> Vector2d;
typedef Vector2<float> Vector2f;

}  // namespace math
}  // namespace ignition

#endif
