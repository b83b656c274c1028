#include "occupancy_level.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace trundle::navigation {

namespace {

constexpr float kMaxLogOdds = 50.0f;  // log odds above which a cell does not become more occupied, as in hector

double probability_of(float log_odds) { return 1.0 / (1.0 + std::exp(-static_cast<double>(log_odds))); }

}  // namespace

OccupancyLevel::OccupancyLevel(int columns, int rows, double resolution, const Point& origin)
    : columns_(columns), rows_(rows), resolution_(resolution), origin_(origin) {
  const std::size_t count = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  log_odds_.resize(count);
  freed_.resize(count);
  occupied_.resize(count);
}

void OccupancyLevel::clear() { std::fill(log_odds_.begin(), log_odds_.end(), 0.0f); }

void OccupancyLevel::enter(const Point& origin, const std::vector<Point>& ends, double free, double occupied) {
  ++scan_;
  const auto cell_of = [this](double place, double first) {
    return static_cast<int>(std::clamp(std::floor((place - first) / resolution_), -1.0, 1e9));
  };
  const int from_column = cell_of(origin.x, origin_.x), from_row = cell_of(origin.y, origin_.y);
  if (!contains(from_column, from_row)) return;
  for (const Point& end : ends) {
    const int column = cell_of(end.x, origin_.x), row = cell_of(end.y, origin_.y);
    if (!contains(column, row)) continue;
    free_ray(from_column, from_row, column, row, static_cast<float>(free));
    const std::size_t cell = index(column, row);
    if (occupied_[cell] == scan_) continue;
    occupied_[cell] = scan_;
    if (freed_[cell] == scan_) log_odds_[cell] -= static_cast<float>(free);
    if (log_odds_[cell] < kMaxLogOdds) log_odds_[cell] += static_cast<float>(occupied);
  }
}

// Bresenham's line, without its last cell.
void OccupancyLevel::free_ray(int from_column, int from_row, int to_column, int to_row, float by) {
  const int width = std::abs(to_column - from_column), height = std::abs(to_row - from_row);
  const int step_column = to_column > from_column ? 1 : -1, step_row = to_row > from_row ? 1 : -1;
  int error = width - height;
  for (int column = from_column, row = from_row; column != to_column || row != to_row;) {
    const std::size_t cell = index(column, row);
    if (freed_[cell] != scan_ && occupied_[cell] != scan_) {
      freed_[cell] = scan_;
      log_odds_[cell] += by;
    }
    const int doubled = 2 * error;
    if (doubled > -height) {
      error -= height;
      column += step_column;
    }
    if (doubled < width) {
      error += width;
      row += step_row;
    }
  }
}

// Interpolates between the centers of four cells.
OccupancyLevel::Sample OccupancyLevel::sample(double x, double y) const {
  const double across = (x - origin_.x) / resolution_ - 0.5, along = (y - origin_.y) / resolution_ - 0.5;
  if (!(across >= 0.0 && along >= 0.0 && across < columns_ - 1 && along < rows_ - 1)) return {0.0, 0.0, 0.0};
  const int column = static_cast<int>(across), row = static_cast<int>(along);
  const double u = across - column, v = along - row;
  const double p00 = probability_of(log_odds_[index(column, row)]);
  const double p10 = probability_of(log_odds_[index(column + 1, row)]);
  const double p01 = probability_of(log_odds_[index(column, row + 1)]);
  const double p11 = probability_of(log_odds_[index(column + 1, row + 1)]);
  const double lower = p00 + u * (p10 - p00), upper = p01 + u * (p11 - p01);
  return {lower + v * (upper - lower), ((1.0 - v) * (p10 - p00) + v * (p11 - p01)) / resolution_,
          (upper - lower) / resolution_};
}

NormalEquations OccupancyLevel::normal_equations(const PlanarPose& pose, const std::vector<Point>& ends) const {
  NormalEquations sums;
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  for (const Point& end : ends) {
    const double dx = c * end.x - s * end.y, dy = s * end.x + c * end.y;
    const Sample at = sample(pose.x + dx, pose.y + dy);
    const double missing = 1.0 - at.probability, by_yaw = dx * at.by_y - dy * at.by_x;
    sums.gradient[0] += at.by_x * missing;
    sums.gradient[1] += at.by_y * missing;
    sums.gradient[2] += by_yaw * missing;
    sums.hessian[0] += at.by_x * at.by_x;
    sums.hessian[1] += at.by_x * at.by_y;
    sums.hessian[2] += at.by_y * at.by_y;
    sums.hessian[3] += at.by_x * by_yaw;
    sums.hessian[4] += at.by_y * by_yaw;
    sums.hessian[5] += by_yaw * by_yaw;
  }
  return sums;
}

double OccupancyLevel::score(const PlanarPose& pose, const std::vector<Point>& ends) const {
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  double sum = 0.0;
  for (const Point& end : ends)
    sum += sample(pose.x + c * end.x - s * end.y, pose.y + s * end.x + c * end.y).probability;
  return ends.empty() ? 0.0 : sum / static_cast<double>(ends.size());
}

}  // namespace trundle::navigation
