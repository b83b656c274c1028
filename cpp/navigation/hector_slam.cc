#include "hector_slam.h"

#include <algorithm>
#include <cmath>

#include "symmetric_solve.h"

namespace trundle::navigation {

namespace {

constexpr int kFineSteps = 6, kCoarseSteps = 4;
constexpr double kMaxTurn = 0.2;           // largest rotation of one step [rad]
constexpr double kRelativeDamping = 1e-6;  // minimum of the Hessian's diagonal: coordinates that no beam measures stay

double log_odds(double probability) { return std::log(probability / (1.0 - probability)); }

}  // namespace

HectorSlam::HectorSlam(const HectorOptions& options) : options_(options) {
  const double length = options.resolution * options.size;
  const Point origin{-options.start_x * length, -options.start_y * length};
  int size = options.size;
  double resolution = options.resolution;
  for (int level = 0; level < options.levels && size > 1; ++level, size /= 2, resolution *= 2.0)
    levels_.emplace_back(size, size, resolution, origin);
}

void HectorSlam::reset() {
  for (OccupancyLevel& level : levels_) level.clear();
  pose_ = entered_ = {};
  has_map_ = false;
}

PlanarPose HectorSlam::match(const PlanarPose& start, const std::vector<Point>& ends) {
  PlanarPose pose = start;
  for (std::size_t number = levels_.size(); number-- > 0;) {
    const OccupancyLevel& level = levels_[number];
    const int steps = number == 0 ? kFineSteps : kCoarseSteps;
    for (int step = 0; step < steps; ++step) {
      NormalEquations sums = level.normal_equations(pose, ends);
      const double moves = kRelativeDamping * (sums.hessian[0] + sums.hessian[2]);
      sums.hessian[0] += moves;
      sums.hessian[2] += moves;
      sums.hessian[5] += kRelativeDamping * sums.hessian[5];
      const std::array<double, 6> inverse = symmetric_inverse(sums.hessian);
      const std::array<double, 3> change = symmetric_product(inverse, sums.gradient);
      if (!std::isfinite(change[0] + change[1] + change[2])) break;
      pose.x += change[0];
      pose.y += change[1];
      pose.yaw = normalized_angle(pose.yaw + std::clamp(change[2], -kMaxTurn, kMaxTurn));
      covariance_ = inverse;
    }
  }
  return pose;
}

bool HectorSlam::update(const PlanarPose& start, const Point& sensor, const std::vector<Point>& ends, bool is_known) {
  pose_ = is_known || !has_map_ || ends.empty() ? start : match(start, ends);
  score_ = levels_[0].score(pose_, ends);
  const bool has_moved = std::hypot(pose_.x - entered_.x, pose_.y - entered_.y) > options_.update_distance ||
                         std::abs(angle_difference(pose_.yaw, entered_.yaw)) > options_.update_angle;
  if (ends.empty() || (has_map_ && !has_moved && !is_known)) return false;
  const double c = std::cos(pose_.yaw), s = std::sin(pose_.yaw);
  const auto in_map = [&](const Point& p) { return Point{pose_.x + c * p.x - s * p.y, pose_.y + s * p.x + c * p.y}; };
  std::vector<Point> placed;
  placed.reserve(ends.size());
  for (const Point& end : ends) placed.push_back(in_map(end));
  for (OccupancyLevel& level : levels_)
    level.enter(in_map(sensor), placed, log_odds(options_.update_factor_free),
                log_odds(options_.update_factor_occupied));
  entered_ = pose_;
  has_map_ = true;
  return true;
}

std::vector<std::int8_t> HectorSlam::cells() const {
  const std::vector<float>& log_odds = levels_[0].log_odds();
  std::vector<std::int8_t> cells(log_odds.size());
  std::transform(log_odds.begin(), log_odds.end(), cells.begin(),
                 [](float odds) { return static_cast<std::int8_t>(odds > 0.0f ? 100 : (odds < 0.0f ? 0 : -1)); });
  return cells;
}

}  // namespace trundle::navigation
