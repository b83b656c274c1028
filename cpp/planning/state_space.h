// Space of a group's variables: what lies between two states, and how far they are from each other.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

namespace trundle::planning {

using State = std::vector<double>;

// Random numbers that are the same on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }  // in [0, 1)
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  std::size_t index(std::size_t count) { return static_cast<std::size_t>(uniform() * static_cast<double>(count)); }
  double gaussian();

 private:
  std::mt19937_64 engine_;
};

struct Dimension {
  double lower = 0.0, upper = 0.0;
  bool is_circle = false;      // turns without end: −π and π are the same
  bool is_quaternion = false;  // first of four, x y z w; the others are plain dimensions from −1 to 1
};

class StateSpace {
 public:
  StateSpace() = default;
  explicit StateSpace(std::vector<Dimension> dimensions);

  std::size_t size() const { return dimensions_.size(); }
  const std::vector<Dimension>& dimensions() const { return dimensions_; }
  bool has_quaternions() const { return has_quaternions_; }
  // Greatest distance of two states.
  double extent() const { return extent_; }

  double distance(std::span<const double> a, std::span<const double> b) const;
  void interpolate(std::span<const double> a, std::span<const double> b, double t, std::span<double> out) const;
  void sample(Random& random, std::span<double> out) const;
  // Values beyond the limits are put onto them; circles into −π … π; quaternions to length 1.
  void clamp(std::span<double> state) const;
  bool is_within(std::span<const double> state, double tolerance) const;

 private:
  std::vector<Dimension> dimensions_;
  std::vector<std::uint8_t> in_quaternion_;
  bool is_plain_ = true;  // neither circles nor quaternions
  bool has_quaternions_ = false;
  double extent_ = 0.0;
};

}  // namespace trundle::planning
