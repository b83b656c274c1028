// Angle [rad].
#ifndef IGNITION_MATH_ANGLE_HH_
#define IGNITION_MATH_ANGLE_HH_

#include <istream>
#include <ostream>

#include <ignition/math/Helpers.hh>

namespace ignition {
namespace math {

class Angle {
 public:
  static const Angle Zero, Pi, HalfPi, TwoPi;

  Angle() : value(0.0) {}
  Angle(double radian) : value(radian) {}  // NOLINT: implicit as in the original

  void Radian(double radian) { value = radian; }
  void SetRadian(double radian) { value = radian; }
  void Degree(double degree) { value = IGN_DTOR(degree); }
  void SetDegree(double degree) { value = IGN_DTOR(degree); }
  double Radian() const { return value; }
  double Degree() const { return IGN_RTOD(value); }
  void Normalize() { value = IGN_NORMALIZE(value); }
  Angle Normalized() const { return IGN_NORMALIZE(value); }
  double operator()() const { return value; }
  double operator*() const { return value; }

  Angle operator+(const Angle& o) const { return value + o.value; }
  Angle operator-(const Angle& o) const { return value - o.value; }
  Angle operator*(const Angle& o) const { return value * o.value; }
  Angle operator/(const Angle& o) const { return value / o.value; }
  Angle operator+=(const Angle& o) { return value += o.value; }
  Angle operator-=(const Angle& o) { return value -= o.value; }
  Angle operator*=(const Angle& o) { return value *= o.value; }
  Angle operator/=(const Angle& o) { return value /= o.value; }
  bool operator==(const Angle& o) const { return equal(value, o.value, 0.001); }
  bool operator!=(const Angle& o) const { return !(*this == o); }
  bool operator<(const Angle& o) const { return value < o.value; }
  bool operator<=(const Angle& o) const { return value <= o.value; }
  bool operator>(const Angle& o) const { return value > o.value; }
  bool operator>=(const Angle& o) const { return value >= o.value; }
  friend std::ostream& operator<<(std::ostream& out, const Angle& a) { return out << a.value; }
  friend std::istream& operator>>(std::istream& in, Angle& a) { return in >> a.value; }

 private:
  double value;
};

}  // namespace math
}  // namespace ignition

#endif
