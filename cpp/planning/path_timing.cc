#include "path_timing.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trundle::planning {

namespace {

constexpr int kLinePoints = 24;  // intervals of the grid on a line or an arc, at least
constexpr int kArcPoints = 24;
constexpr double kGrid = 0.01;  // greatest interval, as a fraction of the length
constexpr int kBisections = 48;
constexpr int kChecks = 8;                 // places of an interval at which the limits are checked in the end
constexpr double kBetweenChecks = 1.0003;  // factor for what limits are exceeded by between those places
constexpr std::size_t kMaxSamples = 200'000;
constexpr int kMaxStretches = 400;

// A place of the grid: its part of the path is that of the interval after it.
struct GridPoint {
  double along;
  std::size_t part;
};

std::vector<GridPoint> make_grid(const BlendedPath& path) {
  std::vector<GridPoint> grid;
  double start = 0.0;
  for (std::size_t part = 0; part < path.ends().size(); ++part) {
    const double length = path.ends()[part] - start;
    const int least = path.is_arc(part) ? kArcPoints : kLinePoints;
    const int count = std::max(least, static_cast<int>(std::ceil(length / (kGrid * path.length()))));
    for (int i = 0; i < count; ++i) grid.push_back({start + length * i / count, part});
    start = path.ends()[part];
  }
  grid.push_back({start, path.ends().size() - 1});
  return grid;
}

// Rows p u + r x <= s with u the acceleration along the path and x the squared speed, for one interval of the grid.
struct Interval {
  double step = 0.0;
  double max_square = 0.0;  // of the speed at its start
  std::vector<double> p, r, s;

  // Bounds of u at a speed; false: none.
  bool bounds(double x, double next_square, double& low, double& high) const {
    low = -x / (2.0 * step);
    high = (next_square - x) / (2.0 * step);
    for (std::size_t j = 0; j < p.size(); ++j) {
      const double left = s[j] - r[j] * x;
      if (std::abs(p[j]) < 1e-12) {
        if (left < -1e-12) return false;
        continue;
      }
      if (p[j] > 0.0) high = std::min(high, left / p[j]);
      else low = std::max(low, left / p[j]);
    }
    return low <= high + 1e-12;
  }
};

double square_of_speed(const State& tangent, const MotionLimits& limits) {
  double speed = 1e9;
  for (std::size_t i = 0; i < tangent.size(); ++i)
    if (std::abs(tangent[i]) > 1e-12) speed = std::min(speed, limits.velocity[i] / std::abs(tangent[i]));
  return speed * speed;
}

std::vector<Interval> make_intervals(const BlendedPath& path, const std::vector<GridPoint>& grid,
                                     const MotionLimits& limits) {
  std::vector<Interval> intervals(grid.size() - 1);
  State point, tangent, curvature;
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    Interval& interval = intervals[k];
    interval.step = grid[k + 1].along - grid[k].along;
    double end_square = 1e18;
    const bool starts_part = k == 0 || grid[k].part != grid[k - 1].part;
    for (int end = 0; end < 2; ++end) {
      path.evaluate(grid[k].part, grid[k + static_cast<std::size_t>(end)].along, point, tangent, curvature);
      const double square = square_of_speed(tangent, limits);
      if (end == 0) interval.max_square = starts_part && path.has_corner_before(grid[k].part) ? 0.0 : square;
      else end_square = square;
      for (std::size_t i = 0; i < tangent.size(); ++i) {
        // tangent u + curvature x at the start; at the end x is x + 2 step u.
        const double p = tangent[i] + (end == 1 ? 2.0 * interval.step * curvature[i] : 0.0);
        for (const double sign : {1.0, -1.0}) {
          interval.p.push_back(sign * p);
          interval.r.push_back(sign * curvature[i]);
          interval.s.push_back(limits.acceleration[i]);
        }
      }
    }
    interval.p.push_back(2.0 * interval.step);
    interval.r.push_back(1.0);
    interval.s.push_back(end_square);
  }
  return intervals;
}

// Greatest squared speeds from which the end can still be reached at rest.
std::vector<double> controllable(const std::vector<Interval>& intervals) {
  std::vector<double> greatest(intervals.size() + 1, 0.0);
  for (std::size_t k = intervals.size(); k-- > 0;) {
    double low = 0.0, high = intervals[k].max_square, u_low = 0.0, u_high = 0.0;
    if (!intervals[k].bounds(high, greatest[k + 1], u_low, u_high)) {
      for (int i = 0; i < kBisections; ++i) {
        const double middle = 0.5 * (low + high);
        (intervals[k].bounds(middle, greatest[k + 1], u_low, u_high) ? low : high) = middle;
      }
      high = low;
    }
    greatest[k] = high;
  }
  return greatest;
}

std::vector<double> fastest(const std::vector<Interval>& intervals) {
  const std::vector<double> greatest = controllable(intervals);
  std::vector<double> squares(greatest.size(), 0.0);
  for (std::size_t k = 0; k < intervals.size(); ++k) {
    double low = 0.0, high = 0.0;
    if (!intervals[k].bounds(squares[k], greatest[k + 1], low, high)) high = low;
    squares[k + 1] = std::clamp(squares[k] + 2.0 * intervals[k].step * high, 0.0, greatest[k + 1]);
  }
  return squares;
}

// Greatest factor by which a limit is exceeded, as a factor of time; 1: none.
double excess(const BlendedPath& path, const std::vector<GridPoint>& grid, const std::vector<double>& squares,
              const MotionLimits& limits) {
  double worst = 1.0;
  State point, tangent, curvature;
  for (std::size_t k = 0; k + 1 < grid.size(); ++k) {
    const double step = grid[k + 1].along - grid[k].along, u = (squares[k + 1] - squares[k]) / (2.0 * step);
    for (int i = 0; i <= kChecks; ++i) {
      const double along = grid[k].along + step * i / kChecks;
      const double square = squares[k] + (squares[k + 1] - squares[k]) * i / kChecks;
      path.evaluate(grid[k].part, along, point, tangent, curvature);
      for (std::size_t j = 0; j < tangent.size(); ++j) {
        worst = std::max(worst, std::abs(tangent[j]) * std::sqrt(square) / limits.velocity[j]);
        const double acceleration = std::abs(tangent[j] * u + curvature[j] * square);
        worst = std::max(worst, std::sqrt(acceleration / limits.acceleration[j]));
      }
    }
  }
  return worst;
}

void check_limits(const MotionLimits& limits, std::size_t size) {
  if (limits.velocity.size() != size || limits.acceleration.size() != size)
    throw std::invalid_argument("each variable has limits");
  for (std::size_t i = 0; i < size; ++i)
    if (!(limits.velocity[i] > 0.0) || !(limits.acceleration[i] > 0.0))
      throw std::invalid_argument("limits are above zero");
}

}  // namespace

TimedStates time_optimal(const BlendedPath& path, const MotionLimits& limits, double step_s) {
  TimedStates timed;
  if (path.ends().empty()) return timed;
  State point, tangent, curvature;
  path.evaluate(0, 0.0, point, tangent, curvature);
  check_limits(limits, point.size());
  const std::vector<GridPoint> grid = make_grid(path);
  const std::vector<double> squares = fastest(make_intervals(path, grid, limits));
  const double slower = kBetweenChecks * excess(path, grid, squares, limits);
  std::vector<double> at{0.0};  // times of the grid
  for (std::size_t k = 0; k + 1 < grid.size(); ++k) {
    const double speeds = std::sqrt(squares[k]) + std::sqrt(squares[k + 1]);
    at.push_back(at.back() + slower * 2.0 * (grid[k + 1].along - grid[k].along) / std::max(speeds, 1e-9));
  }
  const double duration = at.back();
  const auto count =
      static_cast<std::size_t>(std::clamp(std::ceil(duration / step_s), 1.0, static_cast<double>(kMaxSamples)));
  std::size_t k = 0;
  for (std::size_t i = 0; i <= count; ++i) {
    const double time = i == count ? duration : std::min(static_cast<double>(i) * step_s, duration);
    if (i > 0 && i < count && duration - time < 1e-6) continue;
    while (k + 2 < at.size() && at[k + 1] <= time) ++k;
    const double step = grid[k + 1].along - grid[k].along;
    const double u = (squares[k + 1] - squares[k]) / (2.0 * step), tau = (time - at[k]) / slower;
    const double speed = std::max(0.0, std::sqrt(squares[k]) + u * tau);
    const double along = grid[k].along + std::sqrt(squares[k]) * tau + 0.5 * u * tau * tau;
    path.evaluate(grid[k].part, along, point, tangent, curvature);
    State velocity(point.size()), acceleration(point.size());
    for (std::size_t j = 0; j < point.size(); ++j) {
      velocity[j] = i == count ? 0.0 : tangent[j] * speed / slower;
      acceleration[j] = (tangent[j] * u + curvature[j] * speed * speed) / (slower * slower);
    }
    timed.times.push_back(time);
    timed.positions.push_back(point);
    timed.velocities.push_back(std::move(velocity));
    timed.accelerations.push_back(std::move(acceleration));
  }
  return timed;
}

TimedStates time_parabolic(const std::vector<State>& waypoints, const MotionLimits& limits) {
  TimedStates timed;
  if (waypoints.empty()) return timed;
  const std::size_t count = waypoints.size(), n = waypoints[0].size();
  check_limits(limits, n);
  std::vector<double> steps(count > 1 ? count - 1 : 0, 1e-3);
  for (std::size_t i = 0; i + 1 < count; ++i)
    for (std::size_t j = 0; j < n; ++j)
      steps[i] = std::max(steps[i], std::abs(waypoints[i + 1][j] - waypoints[i][j]) / limits.velocity[j]);
  const auto velocity = [&](std::size_t i, std::size_t j) {  // mean of a step
    return (waypoints[i + 1][j] - waypoints[i][j]) / steps[i];
  };
  // At rest before the first and after the last waypoint.
  const auto acceleration = [&](std::size_t i, std::size_t j) {
    if (steps.empty()) return 0.0;
    if (i == 0) return 2.0 * velocity(0, j) / steps[0];
    if (i + 1 == count) return -2.0 * velocity(i - 1, j) / steps[i - 1];
    return 2.0 * (velocity(i, j) - velocity(i - 1, j)) / (steps[i - 1] + steps[i]);
  };
  const auto ratio_at = [&](std::size_t i) {
    double ratio = 0.0;
    for (std::size_t j = 0; j < n; ++j) ratio = std::max(ratio, std::abs(acceleration(i, j)) / limits.acceleration[j]);
    return ratio;
  };
  for (int round = 0; round < kMaxStretches; ++round) {
    bool is_within = true;
    for (std::size_t i = 0; i < count; ++i) {
      const double ratio = ratio_at(i);
      if (ratio <= 1.0) continue;
      is_within = false;
      const double factor = std::min(std::sqrt(ratio), 1.2) * 1.0001;
      if (i > 0) steps[i - 1] *= factor;
      if (i + 1 < count) steps[i] *= factor;
    }
    if (is_within) break;
  }
  double worst = 1.0;
  for (std::size_t i = 0; i < count; ++i) worst = std::max(worst, std::sqrt(ratio_at(i)));
  for (double& step : steps) step *= worst;
  double time = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    State speed(n, 0.0), push(n, 0.0);
    for (std::size_t j = 0; j < n; ++j) {
      if (i > 0 && i + 1 < count) speed[j] = 0.5 * (velocity(i - 1, j) + velocity(i, j));
      push[j] = acceleration(i, j);
    }
    timed.times.push_back(time);
    timed.positions.push_back(waypoints[i]);
    timed.velocities.push_back(std::move(speed));
    timed.accelerations.push_back(std::move(push));
    if (i < steps.size()) time += steps[i];
  }
  return timed;
}

}  // namespace trundle::planning
