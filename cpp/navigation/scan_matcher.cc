#include "scan_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planar_fit.h"

namespace trundle::navigation {

namespace {

constexpr double kNoHit = -0.5;  // log-likelihood of a beam without a hit nearby, times 1 / lsigma, as in gmapping
constexpr int kAlignments = 5;
constexpr double kReach = 0.04;  // deviation of a beam's end from the map's surface [m]
// Part of its draw that a particle keeps where a scan tells nothing. The whole makes ways along corridors uncertain by
// decimetres; without any, particles would be alike when a loop has to choose among them.
constexpr double kKeptDraw = 0.5;

struct Rotation {
  double x, y, c, s;

  explicit Rotation(const PlanarPose& pose) : x(pose.x), y(pose.y), c(std::cos(pose.yaw)), s(std::sin(pose.yaw)) {}
  double map_x(double px, double py) const { return x + c * px - s * py; }
  double map_y(double px, double py) const { return y + s * px + c * py; }
};

// Calls `use` with the way from a beam's end to each mean of hits in the neighborhood whose cell before is free [m],
// and with the number of the hits.
template <typename Use>
void visit_hits(const HitMap& map, const Rotation& rotation, const BeamEnd& beam, int kernel_size, Use use) {
  const double x = rotation.map_x(beam.x, beam.y), y = rotation.map_y(beam.x, beam.y);
  const int column = map.cell_of(x), row = map.cell_of(y);
  const int before_column = map.cell_of(rotation.map_x(beam.before_x, beam.before_y)) - column;
  const int before_row = map.cell_of(rotation.map_y(beam.before_x, beam.before_y)) - row;
  for (int i = -kernel_size; i <= kernel_size; ++i)
    for (int j = -kernel_size; j <= kernel_size; ++j) {
      const Hits* hits = map.find(column + j, row + i);
      if (hits == nullptr || hits->count == 0) continue;
      const Hits* before = map.find(column + j + before_column, row + i + before_row);
      if (before != nullptr && before->count > 0) continue;
      const double scale = 1.0 / hits->count;
      use(map.corner(column + j) + static_cast<double>(hits->x) * scale - x,
          map.corner(row + i) + static_cast<double>(hits->y) * scale - y, hits->count);
    }
}

// Squared distance from a beam's end to the nearest mean of hits [m²]; infinity without any.
double nearest_square(const HitMap& map, const Rotation& rotation, const BeamEnd& beam, int kernel_size) {
  double nearest = std::numeric_limits<double>::infinity();
  visit_hits(map, rotation, beam, kernel_size,
             [&](double dx, double dy, int) { nearest = std::min(nearest, dx * dx + dy * dy); });
  return nearest;
}

// Likelihood of a distance from the map's surface, up to a factor.
double nearness(double square) { return std::exp(-square / (2.0 * kReach * kReach)); }

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

Match ScanMatcher::optimize(const HitMap& map, const PlanarPose& expected, const PlanarPose& drawn,
                            const std::vector<BeamEnd>& beams) const {
  // A large noise draws poses from which the walls are out of reach: the odometry itself may be nearer.
  const Match by_odometry{expected, score(map, expected, beams)}, by_draw{drawn, score(map, drawn, beams)};
  Match best = climb(map, by_odometry.score > by_draw.score ? by_odometry : by_draw, beams);
  const PlanarPose prior{expected.x + kKeptDraw * (drawn.x - expected.x),
                         expected.y + kKeptDraw * (drawn.y - expected.y), expected.yaw};
  best.pose = align(map, best.pose, prior, beams);
  return best;
}

Match ScanMatcher::climb(const HitMap& map, Match best, const std::vector<BeamEnd>& beams) const {
  double linear = options_.linear_step, angular = options_.angular_step;
  for (int halvings = 0; halvings < options_.iterations;) {
    const std::array<PlanarPose, 6> moves{
        {{linear, 0, 0}, {-linear, 0, 0}, {0, -linear, 0}, {0, linear, 0}, {0, 0, angular}, {0, 0, -angular}}};
    const PlanarPose center = best.pose;
    bool is_better = false;
    for (const PlanarPose& move : moves) {
      const PlanarPose pose{center.x + move.x, center.y + move.y, normalized_angle(center.yaw + move.yaw)};
      const double pose_score = score(map, pose, beams);
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

// Brings the surfaces that were hit onto the map's, each along its normal, by Gauss-Newton steps. So a wall tells
// nothing of the way along it, and the prior pose decides.
PlanarPose ScanMatcher::align(const HitMap& map, PlanarPose pose, const PlanarPose& prior,
                              const std::vector<BeamEnd>& beams) const {
  for (int iteration = 0; iteration < kAlignments; ++iteration) {
    const Rotation rotation(pose);
    PlanarFit fit(pose, prior);
    for (const BeamEnd& beam : beams) {
      const double nx = rotation.c * beam.normal_x - rotation.s * beam.normal_y;
      const double ny = rotation.s * beam.normal_x + rotation.c * beam.normal_y;
      double sum = 0.0, weights = 0.0;
      visit_hits(map, rotation, beam, options_.kernel_size, [&](double dx, double dy, int count) {
        const double weight = count * nearness(dx * dx + dy * dy);
        sum += weight * (nx * dx + ny * dy);
        weights += weight;
      });
      if (!(weights > 0.0)) continue;
      const double gap = sum / weights;
      fit.add(nx, ny, beam.x * beam.normal_y - beam.y * beam.normal_x, gap, nearness(gap * gap));
    }
    pose = fit.moved();
  }
  return pose;
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
