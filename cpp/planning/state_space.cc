#include "state_space.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace trundle::planning {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double wrapped(double angle) { return angle - kTurn * std::floor((angle + std::numbers::pi) / kTurn); }

// Angle between two unit quaternions, half of that between the rotations [rad].
double quaternion_angle(const double* a, const double* b) {
  const double product = std::abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]);
  return product >= 1.0 ? 0.0 : std::acos(product);
}

void slerp(const double* a, const double* b, double t, double* out) {
  double product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const double sign = product < 0.0 ? -1.0 : 1.0;
  const double angle = std::acos(std::min(std::abs(product), 1.0));
  const double sine = std::sin(angle);
  const double from = sine > 1e-9 ? std::sin((1.0 - t) * angle) / sine : 1.0 - t;
  const double to = sign * (sine > 1e-9 ? std::sin(t * angle) / sine : t);
  for (int i = 0; i < 4; ++i) out[i] = from * a[i] + to * b[i];
}

}  // namespace

double Random::gaussian() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(kTurn * uniform());
}

StateSpace::StateSpace(std::vector<Dimension> dimensions) : dimensions_(std::move(dimensions)) {
  in_quaternion_.assign(dimensions_.size(), 0);
  double squares = 0.0;
  for (std::size_t i = 0; i < dimensions_.size(); ++i) {
    const Dimension& dimension = dimensions_[i];
    if (in_quaternion_[i]) continue;
    if (dimension.is_quaternion) {
      if (i + 4 > dimensions_.size()) throw std::invalid_argument("a quaternion has four numbers");
      std::fill_n(in_quaternion_.begin() + static_cast<std::ptrdiff_t>(i), 4, std::uint8_t{1});
      has_quaternions_ = true;
      is_plain_ = false;
      squares += std::numbers::pi * std::numbers::pi / 4.0;
      continue;
    }
    if (!std::isfinite(dimension.lower) || !std::isfinite(dimension.upper) || dimension.lower > dimension.upper)
      throw std::invalid_argument("a dimension needs finite limits, the lower one first");
    if (dimension.is_circle) is_plain_ = false;
    const double range = dimension.is_circle ? std::numbers::pi : dimension.upper - dimension.lower;
    squares += range * range;
  }
  extent_ = std::sqrt(squares);
}

double StateSpace::distance(std::span<const double> a, std::span<const double> b) const {
  double squares = 0.0;
  if (is_plain_) {
    for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(squares);
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    double apart = 0.0;
    if (in_quaternion_[i]) {
      apart = quaternion_angle(a.data() + i, b.data() + i);
      i += 3;
    } else {
      apart = dimensions_[i].is_circle ? wrapped(a[i] - b[i]) : a[i] - b[i];
    }
    squares += apart * apart;
  }
  return std::sqrt(squares);
}

void StateSpace::interpolate(std::span<const double> a, std::span<const double> b, double t,
                             std::span<double> out) const {
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (in_quaternion_[i]) {
      slerp(a.data() + i, b.data() + i, t, out.data() + i);
      i += 3;
    } else {
      out[i] = dimensions_[i].is_circle ? wrapped(a[i] + t * wrapped(b[i] - a[i])) : a[i] + t * (b[i] - a[i]);
    }
  }
}

void StateSpace::sample(Random& random, std::span<double> out) const {
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (in_quaternion_[i]) {
      for (std::size_t k = 0; k < 4; ++k) out[i + k] = random.gaussian();
      i += 3;
    } else if (dimensions_[i].is_circle) {
      out[i] = random.uniform(-std::numbers::pi, std::numbers::pi);
    } else {
      out[i] = random.uniform(dimensions_[i].lower, dimensions_[i].upper);
    }
  }
  clamp(out);
}

void StateSpace::clamp(std::span<double> state) const {
  for (std::size_t i = 0; i < state.size(); ++i) {
    if (in_quaternion_[i]) {
      double length = 0.0;
      for (std::size_t k = 0; k < 4; ++k) length += state[i + k] * state[i + k];
      length = std::sqrt(length);
      for (std::size_t k = 0; k < 4; ++k) state[i + k] = length > 1e-12 ? state[i + k] / length : (k == 3 ? 1.0 : 0.0);
      i += 3;
    } else {
      state[i] = dimensions_[i].is_circle ? wrapped(state[i])
                                          : std::clamp(state[i], dimensions_[i].lower, dimensions_[i].upper);
    }
  }
}

bool StateSpace::is_within(std::span<const double> state, double tolerance) const {
  for (std::size_t i = 0; i < state.size(); ++i) {
    if (!std::isfinite(state[i])) return false;
    if (in_quaternion_[i] || dimensions_[i].is_circle) continue;
    if (state[i] < dimensions_[i].lower - tolerance || state[i] > dimensions_[i].upper + tolerance) return false;
  }
  return true;
}

}  // namespace trundle::planning
