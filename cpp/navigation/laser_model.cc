#include "laser_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "planar_fit.h"

namespace trundle::navigation {

// Numbers of the beams in the scan, and their end points in the robot's frame, in cells.
struct LaserModel::Beams {
  std::vector<std::size_t> numbers;
  std::vector<float> x, y;
};

LaserModel::LaserModel(const LaserOptions& options, std::shared_ptr<const OccupancyMap> map)
    : options_(options), map_(std::move(map)) {
  if (options_.kind != LaserKind::kBeam) distances_ = distances_to_occupied(*map_, options_.max_distance);
}

namespace {

constexpr std::size_t kAskedParticles = 32;
// Share of the particles that have to know a beam; those that do not weigh less, though they may be ahead of the map.
// Of close ones nearly all, or scan after scan would draw them back; of others some never know it, but the scan is
// needed.
constexpr double kKnownShare = 0.7, kKnownShareOfClose = 0.95;
constexpr double kStepCells = 0.5;
constexpr double kNearCells = 2.0;  // a wall may be thicker than mapped
constexpr int kAlignments = 5;
constexpr double kReach = 0.1;  // deviation of a beam's end from what the map shows, and of the pose [m]

std::size_t beam_step(const LaserScan& scan, int max_beams) {
  if (scan.ranges.empty() || max_beams < 2) return std::max<std::size_t>(1, scan.ranges.size());
  return std::max<std::size_t>(1, (scan.ranges.size() - 1) / static_cast<std::size_t>(max_beams - 1));
}

double cube(double value) { return value * value * value; }

}  // namespace

LaserModel::Beams LaserModel::used_beams(const LaserScan& scan) const {
  Beams beams;
  const double scale = 1.0 / map_->resolution;
  for (std::size_t i = 0; i < scan.ranges.size(); i += beam_step(scan, options_.max_beams)) {
    if (!(scan.ranges[i] < scan.range_max)) continue;  // nothing was hit; NaN too
    beams.numbers.push_back(i);
    beams.x.push_back(static_cast<float>(scale * (scan.x + scan.ranges[i] * std::cos(scan.bearings[i]))));
    beams.y.push_back(static_cast<float>(scale * (scan.y + scan.ranges[i] * std::sin(scan.bearings[i]))));
  }
  return beams;
}

// Term of a beam's end for each cell in which the end may lie; outside the map, that of the largest distance.
void LaserModel::fill_table(double range_max) {
  if (range_max == table_range_max_) return;
  table_range_max_ = range_max;
  const double random = options_.z_rand / range_max, denominator = 2.0 * options_.sigma_hit * options_.sigma_hit;
  const auto term = [&](double distance) {
    const double p = options_.z_hit * std::exp(-distance * distance / denominator) + random;
    return static_cast<float>(options_.kind == LaserKind::kLikelihoodField ? cube(p) : std::log(p));
  };
  const auto width = static_cast<std::size_t>(map_->width), height = static_cast<std::size_t>(map_->height);
  table_.assign((width + 2) * (height + 2), term(options_.max_distance));
  for (std::size_t row = 0; row < height; ++row)
    for (std::size_t column = 0; column < width; ++column)
      table_[(row + 1) * (width + 2) + column + 1] = term(distances_[row * width + column]);
}

std::optional<double> LaserModel::weigh(std::vector<Particle>& particles, const LaserScan& scan,
                                        const Agreement& agreement) {
  if (options_.kind == LaserKind::kBeam) {
    weigh_by_rays(particles, scan);
    return 0.0;
  }
  fill_table(scan.range_max);
  Beams beams = used_beams(scan);
  const std::size_t count = beams.x.size();
  if (agreement.is_together) {
    keep_known(particles, scan, agreement.is_close ? kKnownShareOfClose : kKnownShare, beams);
    if (beams.x.empty() && count > 0) return std::nullopt;
  }
  const bool may_skip =
      options_.kind == LaserKind::kLikelihoodFieldProb && options_.do_beamskip && agreement.has_converged;
  const double share = count > 0 ? static_cast<double>(beams.x.size()) / static_cast<double>(count) : 1.0;
  return weigh_by_table(particles, beams, share,
                        may_skip ? agreed_beams(particles, beams) : std::vector<char>(beams.x.size(), 1));
}

// Leaves out the beams of which, from less than a share of the particles, the map tells something.
void LaserModel::keep_known(const std::vector<Particle>& particles, const LaserScan& scan, double share,
                            Beams& beams) const {
  const std::size_t step = std::max<std::size_t>(1, particles.size() / kAskedParticles);
  std::vector<PlanarPose> lasers;
  for (std::size_t i = step / 2; i < particles.size(); i += step)
    lasers.push_back(compose(particles[i].pose, {scan.x, scan.y, 0.0}));
  const double needed = share * static_cast<double>(lasers.size());
  Beams known;
  for (std::size_t i = 0; i < beams.x.size(); ++i) {
    const std::size_t number = beams.numbers[i];
    const auto knowing = std::count_if(lasers.begin(), lasers.end(), [&](const PlanarPose& laser) {
      return is_known(laser, scan.ranges[number], scan.bearings[number]);
    });
    if (static_cast<double>(knowing) < needed) continue;
    known.numbers.push_back(number);
    known.x.push_back(beams.x[i]);
    known.y.push_back(beams.y[i]);
  }
  beams = std::move(known);
}

namespace {

// Part of a ray within [0, size) along one axis; empty if there is none.
void clip(double start, double direction, double size, double& from, double& to) {
  if (direction == 0.0) {
    if (!(start >= 0.0 && start < size)) to = -1.0;
    return;
  }
  const double low = -start / direction, high = (size - start) / direction;
  from = std::max(from, std::min(low, high));
  to = std::min(to, std::max(low, high));
}

}  // namespace

// True if the map tells whether a beam is likely: the last known cell on its way is its end, or near an occupied one.
bool LaserModel::is_known(const PlanarPose& laser, double range, double bearing) const {
  const double angle = laser.yaw + bearing, c = std::cos(angle), s = std::sin(angle);
  const double x = (laser.x - map_->origin_x) / map_->resolution, y = (laser.y - map_->origin_y) / map_->resolution;
  const double near = kNearCells * map_->resolution, end = range / map_->resolution;
  if (!std::isfinite(x + y + c)) return false;
  double first = 0.0, last = end;
  clip(x, c, map_->width, first, last);
  clip(y, s, map_->height, first, last);
  for (double length = last; length >= first; length -= kStepCells) {
    const auto column = static_cast<int>(x + length * c), row = static_cast<int>(y + length * s);
    if (!map_->contains(column, row)) continue;
    const auto cell =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(map_->width) + static_cast<std::size_t>(column);
    if (distances_[cell] <= near) return true;
    if (map_->cells[cell] == 0) return length == end;
  }
  return false;
}

PlanarPose LaserModel::align(const PlanarPose& prior, const LaserScan& scan) const {
  const PlanarPose laser = compose(prior, {scan.x, scan.y, 0.0});
  if (distances_.empty() || !std::isfinite(laser.x + laser.y)) return prior;
  // Beams at the end of a wall's known piece would pull the pose back onto it: they are not known all around the prior.
  constexpr std::array<std::pair<double, double>, 5> around{
      {{0, 0}, {kReach, 0}, {-kReach, 0}, {0, kReach}, {0, -kReach}}};
  std::vector<Point> ends;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = scan.ranges[i], bearing = scan.bearings[i];
    const auto is_known_from = [&](const std::pair<double, double>& offset) {
      return is_known({laser.x + offset.first, laser.y + offset.second, laser.yaw}, range, bearing);
    };
    if (range < scan.range_max && std::all_of(around.begin(), around.end(), is_known_from))
      ends.push_back({scan.x + range * std::cos(bearing), scan.y + range * std::sin(bearing)});
  }
  PlanarPose pose = prior;
  for (int i = 0; i < kAlignments; ++i) pose = align_once(pose, prior, ends);
  return pose;
}

PlanarPose LaserModel::align_once(const PlanarPose& pose, const PlanarPose& prior,
                                  const std::vector<Point>& ends) const {
  PlanarFit fit(pose, prior);
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw), scale = 1.0 / map_->resolution;
  const auto width = static_cast<std::size_t>(map_->width);
  for (const Point& end : ends) {
    const double turned_x = c * end.x - s * end.y, turned_y = s * end.x + c * end.y;
    const double x = (pose.x + turned_x - map_->origin_x) * scale - 0.5;
    const double y = (pose.y + turned_y - map_->origin_y) * scale - 0.5;
    if (!(x >= 0.0 && y >= 0.0 && x < map_->width - 1 && y < map_->height - 1)) continue;
    const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
    const double u = x - static_cast<double>(column), v = y - static_cast<double>(row);
    const float* cell = distances_.data() + row * width + column;
    const double below = double{cell[1]} - double{cell[0]}, above = double{cell[width + 1]} - double{cell[width]};
    const double left = double{cell[width]} - double{cell[0]}, right = double{cell[width + 1]} - double{cell[1]};
    const double distance = double{cell[0]} + u * below + v * (left + u * (right - left));
    const double away_x = scale * (below + v * (above - below)), away_y = scale * (left + u * (right - left));
    fit.add(away_x, away_y, turned_x * away_y - turned_y * away_x, -distance,
            std::exp(-distance * distance / (2.0 * kReach * kReach)));
  }
  return fit.moved();
}

namespace {

// Position of a particle in the table, where the cells' centers have whole coordinates.
struct Placement {
  float x, y, c, s;

  Placement(const PlanarPose& pose, const OccupancyMap& map)
      : x(static_cast<float>((pose.x - map.origin_x) / map.resolution + 0.5)),
        y(static_cast<float>((pose.y - map.origin_y) / map.resolution + 0.5)),
        c(static_cast<float>(std::cos(pose.yaw))),
        s(static_cast<float>(std::sin(pose.yaw))) {}
};

// Table, read at the ends of beams, and the bounds of its cells' centers.
class Table {
 public:
  Table(const std::vector<float>& values, const OccupancyMap& map, std::size_t beams)
      : values_(values.data()),
        width_(map.width + 2),
        max_x_(std::nextafter(static_cast<float>(map.width + 1), 0.0f)),
        max_y_(std::nextafter(static_cast<float>(map.height + 1), 0.0f)),
        cells_(beams),
        u_(beams),
        v_(beams) {}

  // Calls `use` with the number of each beam and its term, bilinear between the centers of four cells.
  template <typename Use>
  void read(const PlanarPose& pose, const OccupancyMap& map, const std::vector<float>& beams_x,
            const std::vector<float>& beams_y, Use use) {
    const Placement place(pose, map);
    const std::size_t count = beams_x.size();
    for (std::size_t i = 0; i < count; ++i) {  // vectorized; NaN becomes 0
      const float x = std::min(std::max(0.0f, place.x + place.c * beams_x[i] - place.s * beams_y[i]), max_x_);
      const float y = std::min(std::max(0.0f, place.y + place.s * beams_x[i] + place.c * beams_y[i]), max_y_);
      const int column = static_cast<int>(x), row = static_cast<int>(y);
      u_[i] = x - static_cast<float>(column);
      v_[i] = y - static_cast<float>(row);
      cells_[i] = row * width_ + column;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const float* cell = values_ + cells_[i];
      const float below = cell[0] + u_[i] * (cell[1] - cell[0]);
      const float above = cell[width_] + u_[i] * (cell[width_ + 1] - cell[width_]);
      use(i, below + v_[i] * (above - below));
    }
  }

 private:
  const float* values_;
  int width_;
  float max_x_, max_y_;
  std::vector<int> cells_;
  std::vector<float> u_, v_;
};

}  // namespace

// share: of the scan's beams in `beams`.
double LaserModel::weigh_by_table(std::vector<Particle>& particles, const Beams& beams, double share,
                                  const std::vector<char>& is_used) const {
  Table table(table_, *map_, beams.x.size());
  std::vector<double> sums;
  for (const Particle& particle : particles) {
    float sum = 0.0f;
    table.read(particle.pose, *map_, beams.x, beams.y,
               [&](std::size_t i, float term) { sum += is_used[i] ? term : 0.0f; });
    sums.push_back(double{sum});
  }
  if (options_.kind == LaserKind::kLikelihoodField) {
    double total = 0.0, whole = 0.0;
    for (std::size_t p = 0; p < particles.size(); ++p) {
      whole += particles[p].weight * (1.0 + sums[p] / share);
      particles[p].weight *= 1.0 + sums[p];
      total += particles[p].weight;
    }
    return share < 1.0 && total > 0.0 ? std::log(whole / total) : 0.0;
  }
  // Only ratios matter: the best particle's likelihood is kept from becoming zero.
  const double best = sums.empty() ? 0.0 : *std::max_element(sums.begin(), sums.end());
  for (std::size_t p = 0; p < particles.size(); ++p) particles[p].weight *= std::exp(sums[p] - best);
  return best / share;
}

// Leaves out the beams that few particles explain; if these are nearly all beams, all are used.
std::vector<char> LaserModel::agreed_beams(const std::vector<Particle>& particles, const Beams& beams) const {
  const std::size_t count = beams.x.size();
  // Terms fall with the distance, so that a distance is compared by its term.
  const double random = options_.z_rand / table_range_max_, denominator = 2.0 * options_.sigma_hit * options_.sigma_hit;
  const double skip_square = options_.beam_skip_distance * options_.beam_skip_distance;
  const auto near_term = static_cast<float>(std::log(options_.z_hit * std::exp(-skip_square / denominator) + random));
  std::vector<std::size_t> agreeing(count, 0);
  Table table(table_, *map_, count);
  for (const Particle& particle : particles)
    table.read(particle.pose, *map_, beams.x, beams.y,
               [&](std::size_t i, float term) { agreeing[i] += term > near_term; });
  std::vector<char> is_used(count, 0);
  const double needed = options_.beam_skip_threshold * static_cast<double>(particles.size());
  for (std::size_t i = 0; i < count; ++i) is_used[i] = static_cast<double>(agreeing[i]) > needed;
  const auto skipped = static_cast<double>(std::count(is_used.begin(), is_used.end(), 0));
  if (skipped >= options_.beam_skip_error_threshold * static_cast<double>(count)) is_used.assign(count, 1);
  return is_used;
}

void LaserModel::weigh_by_rays(std::vector<Particle>& particles, const LaserScan& scan) const {
  const double denominator = 2.0 * options_.sigma_hit * options_.sigma_hit;
  const std::size_t step = beam_step(scan, options_.max_beams);
  for (auto& [pose, weight] : particles) {
    const PlanarPose laser = compose(pose, {scan.x, scan.y, 0.0});
    double sum = 1.0;
    for (std::size_t i = 0; i < scan.ranges.size(); i += step) {
      if (std::isnan(scan.ranges[i])) continue;
      const double measured = std::min(scan.ranges[i], scan.range_max);
      const double error = measured - cast_ray(*map_, laser.x, laser.y, pose.yaw + scan.bearings[i], scan.range_max);
      double p = options_.z_hit * std::exp(-error * error / denominator);
      if (error < 0.0) p += options_.z_short * options_.lambda_short * std::exp(-options_.lambda_short * measured);
      p += measured == scan.range_max ? options_.z_max : options_.z_rand / scan.range_max;
      sum += cube(p);
    }
    weight *= sum;
  }
}

}  // namespace trundle::navigation
