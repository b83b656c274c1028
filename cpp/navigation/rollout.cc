#include "rollout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "wave_front.h"

namespace trundle {

namespace {

constexpr double kCollision = -1;
constexpr double kUnknown = -2;
constexpr std::uint8_t kInscribed = 253;
constexpr int kMaxSteps = 10000;
constexpr std::size_t kRoundCorners = 12;
constexpr double kRoundShare = 0.1;  // tolerance of the radius, which padding along the axes changes

std::array<int, 2> cell_of(const RolloutMaps& maps, double x, double y) {
  const auto number = [&](double value, double origin, int count) {
    const double cell = std::floor((value - origin) / maps.resolution);
    return cell >= 0 && cell < count ? static_cast<int>(cell) : -1;
  };
  return {number(x, maps.origin[0], maps.shape.width), number(y, maps.origin[1], maps.shape.height)};
}

double distance_at(const RolloutMaps& maps, const float* field, double x, double y) {
  const auto [column, row] = cell_of(maps, x, y);
  if (!maps.shape.contains(column, row)) return kUnreached;
  return static_cast<double>(field[maps.shape.index(column, row)]);
}

double approach(double from, double to, double limit) {
  return from < to ? std::min(to, from + limit) : std::max(to, from - limit);
}

}  // namespace

std::vector<Triple> roll_out(const RolloutSettings& settings, Triple pose, Triple velocity, const Triple& target) {
  const double speed = std::hypot(target[0], target[1]);
  const double length = speed * settings.sim_time / settings.granularity;
  const double turn = std::fabs(target[2]) * settings.sim_time / settings.angular_granularity;
  const double wanted = std::ceil(std::max(length, turn));
  const int steps = wanted < kMaxSteps ? static_cast<int>(wanted) : kMaxSteps;
  std::vector<Triple> poses(static_cast<std::size_t>(std::max(steps, 0)));
  const double dt = settings.sim_time / std::max(steps, 1);
  if (!settings.accelerates) velocity = target;
  for (Triple& next : poses) {
    for (std::size_t axis = 0; axis < 3 && settings.accelerates; ++axis)
      velocity[axis] = approach(velocity[axis], target[axis], settings.acceleration[axis] * dt);
    const double cosine = std::cos(pose[2]);
    const double sine = std::sin(pose[2]);
    pose[0] += (velocity[0] * cosine - velocity[1] * sine) * dt;
    pose[1] += (velocity[0] * sine + velocity[1] * cosine) * dt;
    pose[2] += velocity[2] * dt;
    next = pose;
  }
  return poses;
}

double footprint_cost(const RolloutMaps& maps, const Polygon& footprint, const Triple& pose) {
  const auto [x, y] = cell_of(maps, pose[0], pose[1]);
  if (!maps.shape.contains(x, y)) return kUnknown;
  const std::uint8_t center = maps.costs[maps.shape.index(x, y)];
  if (footprint.size() < 3) {
    if (center == kNoInformation) return kUnknown;
    return center >= kInscribed ? kCollision : center;
  }
  double highest = center;
  if (center == kNoInformation) return kUnknown;
  const double cosine = std::cos(pose[2]);
  const double sine = std::sin(pose[2]);
  const auto corner = [&](const std::array<double, 2>& point) {
    return cell_of(maps, pose[0] + point[0] * cosine - point[1] * sine, pose[1] + point[0] * sine + point[1] * cosine);
  };
  std::array<int, 2> last = corner(footprint.back());
  for (const auto& point : footprint) {
    const std::array<int, 2> next = corner(point);
    if (!maps.shape.contains(last[0], last[1]) || !maps.shape.contains(next[0], next[1])) return kUnknown;
    visit_line(last[0], last[1], next[0], next[1], maps.shape.width + maps.shape.height, [&](int column, int row) {
      const std::uint8_t cost = maps.costs[maps.shape.index(column, row)];
      if (cost >= kLethalObstacle) highest = cost == kNoInformation ? kUnknown : kCollision;
      else highest = std::max(highest, static_cast<double>(cost));
      return highest >= 0;
    });
    if (highest < 0) return highest;
    last = next;
  }
  return highest;
}

FootprintCosts::FootprintCosts(const RolloutMaps& maps, Polygon footprint)
    : maps_(maps), footprint_(std::move(footprint)) {
  if (footprint_.size() < kRoundCorners) return;
  const double radius = std::hypot(footprint_[0][0], footprint_[0][1]);
  for (const auto& point : footprint_)
    if (std::fabs(std::hypot(point[0], point[1]) - radius) > kRoundShare * radius) return;
  known_.assign(4 * maps.shape.size(), std::numeric_limits<float>::quiet_NaN());
}

double FootprintCosts::at(const Triple& pose) {
  if (known_.empty()) return footprint_cost(maps_, footprint_, pose);
  const double half = maps_.resolution / 2;
  const double x = std::floor((pose[0] - maps_.origin[0]) / half);
  const double y = std::floor((pose[1] - maps_.origin[1]) / half);
  if (!(x >= 0 && y >= 0 && x < 2.0 * maps_.shape.width && y < 2.0 * maps_.shape.height)) return kUnknown;
  const auto columns = static_cast<std::size_t>(2 * maps_.shape.width);
  float& known = known_[static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x)];
  if (std::isnan(known)) {
    const Triple center{maps_.origin[0] + (x + 0.5) * half, maps_.origin[1] + (y + 0.5) * half, 0};
    known = static_cast<float>(footprint_cost(maps_, footprint_, center));
  }
  return static_cast<double>(known);
}

RolloutScore score_rollout(const RolloutSettings& settings, FootprintCosts& costs, const std::vector<Triple>& poses) {
  const RolloutMaps& maps = costs.maps();
  RolloutScore score{0, 0, 0, 0, 0, static_cast<double>(poses.size())};
  for (const Triple& pose : poses) {
    const double cost = costs.at(pose);
    if (cost < 0) {
      score.obstacles = cost;
      return score;
    }
    score.obstacles = settings.sums_costs ? score.obstacles + cost : std::max(score.obstacles, cost);
  }
  if (poses.empty()) return score;
  const Triple& end = poses.back();
  const double x = end[0] + settings.forward_point * std::cos(end[2]);
  const double y = end[1] + settings.forward_point * std::sin(end[2]);
  score.path = distance_at(maps, maps.path, end[0], end[1]);
  score.goal = distance_at(maps, maps.goal, end[0], end[1]);
  score.front = distance_at(maps, maps.front, x, y);
  score.alignment = distance_at(maps, maps.path, x, y);
  return score;
}

}  // namespace trundle
