// Costs of a timed band as weighted squares of residuals, each with its derivatives.
//
// Unknowns: x, y, yaw and the step that follows, for each pose; a residual depends on three poses in a row at most.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

#include "dual.h"
#include "timed_band.h"

namespace trundle::navigation {

constexpr std::size_t kPerPose = 4;

template <std::size_t N>
struct BandStep {  // of a robot from one pose to the next, as speeds ahead, sideways and turning
  Dual<N> x, y, turn, time;
};

// Residual of a value that exceeds low … high by more than -margin.
template <std::size_t N>
Dual<N> outside(const Dual<N>& value, double low, double high, double margin) {
  if (value.value < low + margin) return Dual<N>(low + margin) - value;
  if (value.value > high - margin) return value - Dual<N>(high - margin);
  return Dual<N>();
}

template <std::size_t N>
Dual<N> below(const Dual<N>& value, double low) {
  return value.value < low ? Dual<N>(low) - value : Dual<N>();
}

// Sink: Number<N>, the type of residuals by N unknowns; add(first pose, residual, weight).
template <typename Sink>
class BandTerms {
 public:
  BandTerms(const TimedBand& band, const BandSettings& settings, const std::array<double, 3>& velocity, Sink& sink)
      : band_(band), s_(settings), velocity_(velocity), sink_(sink) {}

  void add() {
    const std::size_t count = band_.steps.size();
    for (std::size_t i = 0; i < count; ++i) {
      add_times(i);
      add_kinematics(i);
      add_speeds(i);
      if (i + 1 < count) add_acceleration(i);
    }
    add_ends(count - 1);
  }

 private:
  template <std::size_t N>
  using Number = typename Sink::template Number<N>;
  template <typename N>
  struct Place {
    N x, y, yaw;
  };

  template <typename N>
  static N variable(double value, std::size_t index) {
    N number(value);
    if (index < number.slope.size()) number.slope[index] = 1.0;
    return number;
  }
  // The pose i as variables of residuals that begin at the pose `first`.
  template <typename N>
  Place<N> pose(std::size_t i, std::size_t first) const {
    const std::size_t index = kPerPose * (i - first);
    const BandPose& p = band_.poses[i];
    return {variable<N>(p[0], index), variable<N>(p[1], index + 1), variable<N>(p[2], index + 2)};
  }
  template <typename N>
  N step(std::size_t i, std::size_t first) const {
    return variable<N>(band_.steps[i], kPerPose * (i - first) + 3);
  }
  [[nodiscard]] bool is_holonomic() const { return s_.max_vel_y > 0.0; }
  [[nodiscard]] double margin(double limit) const { return std::min(s_.penalty_epsilon, 0.5 * limit); }

  // Length of the way between two poses, as a chord or as an arc.
  template <typename N>
  N way(const N& dx, const N& dy, const N& turn) const {
    const N chord = length(dx, dy);
    if (!s_.exact_arc_length || std::abs(turn.value) < 1e-6) return chord;
    return magnitude(chord * turn / (N(2.0) * sine(turn * N(0.5))));
  }

  template <typename N>
  auto motion(std::size_t i, std::size_t first) const {
    const auto a = pose<N>(i, first), b = pose<N>(i + 1, first);
    const N time = step<N>(i, first), dx = b.x - a.x, dy = b.y - a.y, turn = wrapped(b.yaw - a.yaw);
    const N c = cosine(a.yaw), s = sine(a.yaw), ahead = c * dx + s * dy;
    BandStep<std::tuple_size_v<decltype(time.slope)>> result{ahead / time, N(), turn / time, time};
    if (is_holonomic()) {
      result.y = (c * dy - s * dx) / time;
    } else {
      const N steep = ahead * N(100.0);  // the sign, with a derivative
      result.x = way(dx, dy, turn) / time * steep / (N(1.0) + magnitude(steep));
    }
    return result;
  }

  void add_times(std::size_t i) {
    using N = Number<2 * kPerPose>;
    sink_.add(i, step<N>(i, i), s_.weight_optimaltime);
    if (s_.weight_shortest_path > 0.0) {
      const auto a = pose<N>(i, i), b = pose<N>(i + 1, i);
      sink_.add(i, length(b.x - a.x, b.y - a.y), s_.weight_shortest_path);
    }
  }

  // A robot on wheels moves along arcs: both ends' directions meet the chord at the same angle.
  void add_kinematics(std::size_t i) {
    if (is_holonomic()) return;
    using N = Number<2 * kPerPose>;
    const auto a = pose<N>(i, i), b = pose<N>(i + 1, i);
    const N dx = b.x - a.x, dy = b.y - a.y;
    const N c = cosine(a.yaw), s = sine(a.yaw);
    sink_.add(i, (c + cosine(b.yaw)) * dy - (s + sine(b.yaw)) * dx, s_.weight_kinematics_nh);
    if (!(s_.min_turning_radius > 0.0)) {
      sink_.add(i, below(c * dx + s * dy, 0.0), s_.weight_kinematics_forward_drive);
      return;
    }
    // The way that the turn needs at least; unlike the radius it has no pole. It is a small length, as above.
    const N turn = magnitude(wrapped(b.yaw - a.yaw)), missing = turn * N(kSaferRadius * s_.min_turning_radius);
    const N lack = missing - length(dx, dy);
    if (lack.value > 0.0) sink_.add(i, lack, s_.weight_kinematics_turning_radius * s_.weight_kinematics_nh);
  }

  void add_speeds(std::size_t i) {
    const auto v = motion<Number<2 * kPerPose>>(i, i);
    sink_.add(i, outside(v.x, -s_.max_vel_x_backwards, s_.max_vel_x, margin(s_.max_vel_x_backwards)),
              s_.weight_max_vel_x);
    if (is_holonomic()) {
      sink_.add(i, outside(v.y, -s_.max_vel_y, s_.max_vel_y, margin(s_.max_vel_y)), s_.weight_max_vel_y);
      const double most = std::max(s_.max_vel_trans, s_.max_vel_x);
      sink_.add(i, outside(length(v.x, v.y), -most, most, margin(most)), s_.weight_max_vel_x);
    }
    sink_.add(i, outside(v.turn, -s_.max_vel_theta, s_.max_vel_theta, margin(s_.max_vel_theta)),
              s_.weight_max_vel_theta);
  }

  template <typename N>
  void add_change(std::size_t first, const N& change, const N& time, double limit, double weight) {
    sink_.add(first, outside(change / time, -limit, limit, margin(limit)), weight);
  }

  void add_acceleration(std::size_t i) {
    using N = Number<3 * kPerPose>;
    const auto v = motion<N>(i, i), w = motion<N>(i + 1, i);
    const N time = (v.time + w.time) * N(0.5);
    add_change(i, w.x - v.x, time, s_.acc_lim_x, s_.weight_acc_lim_x);
    if (is_holonomic()) add_change(i, w.y - v.y, time, s_.acc_lim_y, s_.weight_acc_lim_y);
    add_change(i, w.turn - v.turn, time, s_.acc_lim_theta, s_.weight_acc_lim_theta);
  }

  // From the robot's velocity, and to rest at the goal.
  void add_ends(std::size_t last) {
    using N = Number<2 * kPerPose>;
    const auto add_end = [&](std::size_t i, const std::array<double, 3>& other) {
      const auto v = motion<N>(i, i);
      add_change(i, v.x - N(other[0]), v.time, s_.acc_lim_x, s_.weight_acc_lim_x);
      if (is_holonomic()) add_change(i, v.y - N(other[1]), v.time, s_.acc_lim_y, s_.weight_acc_lim_y);
      add_change(i, v.turn - N(other[2]), v.time, s_.acc_lim_theta, s_.weight_acc_lim_theta);
    };
    add_end(0, velocity_);
    if (!s_.free_goal_vel) add_end(last, {});
  }

  static constexpr double kSaferRadius = 1.05;

  const TimedBand& band_;
  const BandSettings& s_;
  const std::array<double, 3>& velocity_;
  Sink& sink_;
};

}  // namespace trundle::navigation
