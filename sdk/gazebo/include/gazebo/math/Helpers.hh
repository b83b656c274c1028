// Numbers, as in Gazebo up to 8.
#ifndef GAZEBO_MATH_HELPERS_HH_
#define GAZEBO_MATH_HELPERS_HH_

#include <cmath>
#include <string>

#include <ignition/math/Helpers.hh>

#define GZ_DBL_MAX (ignition::math::MAX_D)
#define GZ_DBL_MIN (ignition::math::MIN_D)
#define GZ_FLT_MAX (std::numeric_limits<float>::max())
#define GZ_UINT32_MAX (std::numeric_limits<uint32_t>::max())

namespace gazebo {
namespace math {

using ignition::math::clamp;
using ignition::math::equal;
using ignition::math::parseFloat;
using ignition::math::parseInt;
using ignition::math::precision;

template <typename T>
inline bool isnan(T value) {
  return std::isnan(value);
}
inline double fixnan(double value) { return ignition::math::fixnan(value); }
inline bool isPowerOfTwo(unsigned int value) { return value && !(value & (value - 1)); }

}  // namespace math
}  // namespace gazebo

#endif
