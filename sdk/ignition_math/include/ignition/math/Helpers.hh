// Numbers: comparison, limits, conversion.
#ifndef IGNITION_MATH_HELPERS_HH_
#define IGNITION_MATH_HELPERS_HH_

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>

#define IGN_PI 3.14159265358979323846
#define IGN_PI_2 1.57079632679489661923
#define IGN_PI_4 0.78539816339744830962
#define IGN_SQRT2 1.41421356237309504880
#define IGN_RTOD(r) ((r) * 180 / IGN_PI)
#define IGN_DTOR(d) ((d) * IGN_PI / 180)
#define IGN_NORMALIZE(a) (std::atan2(std::sin(a), std::cos(a)))

namespace ignition {
namespace math {

const double NAN_D = std::numeric_limits<double>::quiet_NaN();
const float NAN_F = std::numeric_limits<float>::quiet_NaN();
const double INF_D = std::numeric_limits<double>::infinity();
const double MAX_D = std::numeric_limits<double>::max();
const double MIN_D = std::numeric_limits<double>::min();
const double LOW_D = std::numeric_limits<double>::lowest();

template <typename T>
inline T clamp(T value, T low, T high) {
  return std::max(std::min(value, high), low);
}

inline bool isnan(double value) { return std::isnan(value); }
inline double fixnan(double value) { return std::isfinite(value) ? value : 0.0; }
inline bool isEven(int value) { return value % 2 == 0; }
inline bool isOdd(int value) { return value % 2 != 0; }

template <typename T>
inline int sgn(T value) {
  return (T(0) < value) - (value < T(0));
}

template <typename T>
inline int signum(T value) {
  return sgn(value);
}

template <typename T>
inline bool equal(const T& a, const T& b, const T& tolerance = T(1e-6)) {
  return std::abs(double(a) - double(b)) <= double(tolerance);
}

template <typename T>
inline bool lessOrNearEqual(const T& a, const T& b, const T& tolerance = T(1e-6)) {
  return a < b + tolerance;
}

template <typename T>
inline bool greaterOrNearEqual(const T& a, const T& b, const T& tolerance = T(1e-6)) {
  return a + tolerance > b;
}

template <typename T>
inline T precision(const T& value, const unsigned int& digits) {
  const double power = std::pow(10.0, digits);
  return static_cast<T>(std::round(value * power) / power);
}

inline int parseInt(const std::string& text) {
  std::istringstream in(text);
  int value = 0;
  return in >> value ? value : std::numeric_limits<int>::min();
}

inline double parseFloat(const std::string& text) {
  std::istringstream in(text);
  double value = 0.0;
  return in >> value ? value : NAN_D;
}

inline unsigned int roundUpPowerOfTwo(unsigned int value) {
  unsigned int power = 1;
  while (power < value && power) power <<= 1;
  return power;
}

}  // namespace math
}  // namespace ignition

#endif
