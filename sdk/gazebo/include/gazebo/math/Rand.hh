// Random numbers, as in Gazebo up to 8.
#ifndef GAZEBO_MATH_RAND_HH_
#define GAZEBO_MATH_RAND_HH_

#include <ignition/math/Rand.hh>

namespace gazebo {
namespace math {

class Rand {
 public:
  static void SetSeed(uint32_t seed) { ignition::math::Rand::Seed(seed); }
  static uint32_t GetSeed() { return ignition::math::Rand::Seed(); }
  static double GetDblUniform(double low = 0, double high = 1) { return ignition::math::Rand::DblUniform(low, high); }
  static double GetDblNormal(double mean = 0, double sigma = 1) { return ignition::math::Rand::DblNormal(mean, sigma); }
  static int32_t GetIntUniform(int low, int high) { return ignition::math::Rand::IntUniform(low, high); }
  static int32_t GetIntNormal(int mean, int sigma) { return ignition::math::Rand::IntNormal(mean, sigma); }
};

}  // namespace math
}  // namespace gazebo

#endif
