#include "scan_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trundle::navigation {

namespace {

constexpr double kNoHit = -0.5;  // log-likelihood of a beam without a hit nearby, times 1 / lsigma, as in gmapping
// Score that each beam loses by a move of 1 m or a turn of 1 rad away from the odometry, times the square: where a scan
// tells nothing, as along a corridor, noise moves the pose no longer. Elsewhere 0.1 m costs twenty times as much.
constexpr double kStartWeight = 1.0;

struct Rotation {
  double x, y, c, s;

  explicit Rotation(const PlanarPose& pose) : x(pose.x), y(pose.y), c(std::cos(pose.yaw)), s(std::sin(pose.yaw)) {}
  double map_x(double px, double py) const { return x + c * px - s * py; }
  double map_y(double px, double py) const { return y + s * px + c * py; }
};

// Squared distance from a beam's end to the nearest mean of hits in the neighborhood whose cell before is free [m²];
// infinity without any.
double nearest_square(const HitMap& map, const Rotation& rotation, const BeamEnd& beam, int kernel_size) {
  const double x = rotation.map_x(beam.x, beam.y), y = rotation.map_y(beam.x, beam.y);
  const int column = map.cell_of(x), row = map.cell_of(y);
  const int before_column = map.cell_of(rotation.map_x(beam.before_x, beam.before_y)) - column;
  const int before_row = map.cell_of(rotation.map_y(beam.before_x, beam.before_y)) - row;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = -kernel_size; i <= kernel_size; ++i)
    for (int j = -kernel_size; j <= kernel_size; ++j) {
      const Hits* hits = map.find(column + j, row + i);
      if (hits == nullptr || hits->count == 0) continue;
      const Hits* before = map.find(column + j + before_column, row + i + before_row);
      if (before != nullptr && before->count > 0) continue;
      const double scale = 1.0 / hits->count;
      const double dx = x - map.corner(column + j) - static_cast<double>(hits->x) * scale;
      const double dy = y - map.corner(row + i) - static_cast<double>(hits->y) * scale;
      nearest = std::min(nearest, dx * dx + dy * dy);
    }
  return nearest;
}

}  // namespace

double ScanMatcher::score(const HitMap& map, const PlanarPose& pose, const std::vector<BeamEnd>& beams) const {
  const Rotation rotation(pose);
  const double factor = -1.0 / options_.sigma;  // as in gmapping, which does not square it
  double sum = 0.0;
  for (const BeamEnd& beam : beams) {
    const double square = nearest_square(map, rotation, beam, options_.kernel_size);
    if (square < std::numeric_limits<double>::infinity()) sum += std::exp(factor * square);
  }
  return sum;
}

Match ScanMatcher::optimize(const HitMap& map, const PlanarPose& start, const std::vector<BeamEnd>& beams) const {
  Match best{start, score(map, start, beams)};
  const double weight = kStartWeight * static_cast<double>(beams.size());
  double linear = options_.linear_step, angular = options_.angular_step;
  for (int halvings = 0; halvings < options_.iterations;) {
    const std::array<PlanarPose, 6> moves{
        {{linear, 0, 0}, {-linear, 0, 0}, {0, -linear, 0}, {0, linear, 0}, {0, 0, angular}, {0, 0, -angular}}};
    const PlanarPose center = best.pose;
    bool is_better = false;
    for (const PlanarPose& move : moves) {
      const PlanarPose pose{center.x + move.x, center.y + move.y, normalized_angle(center.yaw + move.yaw)};
      const double dx = pose.x - start.x, dy = pose.y - start.y, turn = angle_difference(pose.yaw, start.yaw);
      const double pose_score = score(map, pose, beams) - weight * (dx * dx + dy * dy + turn * turn);
      if (pose_score <= best.score) continue;
      best = {pose, pose_score};
      is_better = true;
    }
    if (is_better) continue;
    ++halvings;
    linear /= 2.0;
    angular /= 2.0;
  }
  return best;
}

double ScanMatcher::log_likelihood(const HitMap& map, const PlanarPose& pose, const std::vector<BeamEnd>& beams) const {
  const Rotation rotation(pose);
  const double factor = -1.0 / options_.likelihood_sigma;
  const double no_hit = kNoHit / options_.likelihood_sigma;
  double sum = 0.0;
  const auto step = static_cast<std::size_t>(std::max(options_.skipped_beams, 0)) + 1;
  for (std::size_t i = 0; i < beams.size(); i += step) {
    const double square = nearest_square(map, rotation, beams[i], options_.kernel_size);
    sum += square < std::numeric_limits<double>::infinity() ? factor * square : no_hit;
  }
  return sum;
}

}  // namespace trundle::navigation
