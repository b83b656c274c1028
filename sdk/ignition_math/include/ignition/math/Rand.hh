// Random numbers; those of all plugins in a library come from one seed.
#ifndef IGNITION_MATH_RAND_HH_
#define IGNITION_MATH_RAND_HH_

#include <cstdint>
#include <random>

namespace ignition {
namespace math {

class Rand {
 public:
  static void Seed(unsigned int seed) { Generator().seed(Number() = seed); }
  static unsigned int Seed() { return Number(); }
  static double DblUniform(double low = 0, double high = 1) {
    return std::uniform_real_distribution<double>(low, high)(Generator());
  }
  static double DblNormal(double mean = 0, double sigma = 1) {
    return sigma > 0 ? std::normal_distribution<double>(mean, sigma)(Generator()) : mean;
  }
  static int32_t IntUniform(int low, int high) {
    return std::uniform_int_distribution<int32_t>(low, high)(Generator());
  }
  static int32_t IntNormal(int mean, int sigma) { return static_cast<int32_t>(DblNormal(mean, sigma)); }

 private:
  static unsigned int& Number() {
    static unsigned int number = std::mt19937::default_seed;
    return number;
  }
  static std::mt19937& Generator() {
    static std::mt19937 generator;
    return generator;
  }
};

}  // namespace math
}  // namespace ignition

#endif
