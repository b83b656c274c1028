#include "grid_slam.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "range_scan.h"

namespace trundle::navigation {

namespace {

constexpr double kNoHit = std::numeric_limits<double>::infinity();
constexpr std::size_t kComparedScans = 500;
constexpr double kLeastShare = 0.05;  // fewer beams that can be compared tell nothing

}  // namespace

GridSlam::GridSlam(const SlamOptions& options, std::vector<double> bearings, const PlanarPose& pose, std::uint64_t seed)
    : options_(options),
      bearings_(std::move(bearings)),
      places_(bearings_, std::min(options.usable_range, options.max_range)),
      matcher_(options.match),
      random_(seed),
      particles_(static_cast<std::size_t>(std::max(options.particles, 1)), Particle{pose, pose, HitMap(options.delta)}),
      counts_(options.delta) {}

// As gmapping's motion model: noise grows with the distances along each axis, not with their squares.
void GridSlam::drift(Particle& particle, const PlanarPose& motion) {
  const auto& [srr, srt, str, stt] = std::array<double, 4>{options_.srr, options_.srt, options_.str, options_.stt};
  const double forward = std::abs(motion.x), sideways = std::abs(motion.y), turn = std::abs(motion.yaw);
  const PlanarPose noisy{
      motion.x + random_.gaussian(srr * forward + str * turn + 0.3 * srr * sideways),
      motion.y + random_.gaussian(srr * sideways + str * turn + 0.3 * srr * forward),
      normalized_angle(motion.yaw + random_.gaussian(stt * turn + srt * std::hypot(motion.x, motion.y)))};
  particle.pose = compose(particle.pose, noisy);
  particle.expected = compose(particle.expected, motion);
}

bool GridSlam::process(const PlanarPose& odometry, double time_s, const std::vector<double>& ranges) {
  if (has_started_) {
    const PlanarPose motion = compose(inverse(odometry_), odometry);
    for (Particle& particle : particles_) drift(particle, motion);
    driven_ += std::hypot(motion.x, motion.y);
    turned_ += std::abs(motion.yaw);
  }
  odometry_ = odometry;
  const bool is_due = options_.temporal_update >= 0.0 && time_s - last_time_s_ > options_.temporal_update;
  if (has_started_ && driven_ < options_.linear_update && turned_ < options_.angular_update && !is_due) return false;
  driven_ = turned_ = 0.0;
  last_time_s_ = time_s;
  std::vector<float> kept;
  for (const double range : ranges) {
    const double hit = range <= options_.max_range ? range : kNoHit;
    kept.push_back(range > 0.0 ? static_cast<float>(hit) : 0.0f);  // NaN is no measurement
  }
  kept.resize(bearings_.size(), 0.0f);
  scans_.push_back(std::move(kept));
  if (has_started_) {
    match();
    resample_if_needed();
  }
  has_started_ = true;
  register_scan();
  return true;
}

bool GridSlam::has_end(float range) const { return range > 0.0f && double{range} <= options_.usable_range; }

// Ends of the last scan's beams.
std::vector<BeamEnd> GridSlam::beam_ends() const {
  const double before = std::numbers::sqrt2 * options_.delta;
  std::vector<BeamEnd> beams;
  RangeScan scan;
  for (std::size_t i = 0; i < scans_.back().size(); ++i) {
    if (!has_end(scans_.back()[i])) continue;
    const double range = double{scans_.back()[i]}, c = std::cos(bearings_[i]), s = std::sin(bearings_[i]);
    beams.push_back({range * c, range * s, (range - before) * c, (range - before) * s, 0.0, 0.0});
    scan.hits.push_back({range * c, range * s});
  }
  find_normals(scan);
  for (std::size_t i = 0; i < beams.size(); ++i) {
    beams[i].normal_x = scan.normals[i].x;
    beams[i].normal_y = scan.normals[i].y;
  }
  return beams;
}

// Ends of the last scan's beams where an earlier one may have had an end, too. Others tell nothing, but would hold the
// robot back where something is known. count: of all beams that end.
std::vector<BeamEnd> GridSlam::comparable_ends(std::size_t& count) const {
  const Particle& particle = particles_[best()];
  std::vector<RegisteredScan> earlier;
  for (int node = particle.node; node >= 0 && earlier.size() < kComparedScans;) {
    const Node& one = nodes_[static_cast<std::size_t>(node)];
    earlier.push_back({one.pose, &scans_[static_cast<std::size_t>(one.scan)]});
    node = one.parent;
  }
  const std::vector<char> is_seen = places_.seen_ends({particle.pose, &scans_.back()}, earlier);
  const std::vector<BeamEnd> beams = beam_ends();
  count = beams.size();
  std::vector<BeamEnd> seen;
  std::size_t number = 0;
  for (std::size_t i = 0; i < is_seen.size(); ++i) {
    if (!has_end(scans_.back()[i])) continue;
    if (is_seen[i] != 0) seen.push_back(beams[number]);
    ++number;
  }
  return seen;
}

void GridSlam::match() {
  std::size_t count = 0;
  const std::vector<BeamEnd> beams = comparable_ends(count);
  const double share = count == 0 ? 1.0 : static_cast<double>(beams.size()) / static_cast<double>(count);
  if (count > 0 && share < kLeastShare) return;
  int unmatched = 0;
  for (Particle& particle : particles_) {
    const Match match = matcher_.optimize(particle.map, particle.expected, particle.pose, beams);
    if (match.score > options_.minimum_score * share) particle.pose = match.pose;
    else ++unmatched;
    particle.log_weight += matcher_.log_likelihood(particle.map, particle.pose, beams);
  }
  unmatched_share_ = static_cast<double>(unmatched) / static_cast<double>(particles_.size());
}

std::vector<double> GridSlam::weights() const {
  const double gain = 1.0 / (options_.likelihood_gain * static_cast<double>(particles_.size()));
  double highest = -std::numeric_limits<double>::infinity();
  for (const Particle& particle : particles_) highest = std::max(highest, particle.log_weight);
  std::vector<double> weights;
  double sum = 0.0;
  for (const Particle& particle : particles_) {
    weights.push_back(std::exp(gain * (particle.log_weight - highest)));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

double GridSlam::entropy() const {
  double entropy = 0.0;
  for (const double weight : weights())
    if (weight > 0.0) entropy -= weight * std::log(weight);
  return entropy;
}

std::size_t GridSlam::best() const {
  const auto heaviest =
      std::max_element(particles_.begin(), particles_.end(),
                       [](const Particle& a, const Particle& b) { return a.log_weight < b.log_weight; });
  return static_cast<std::size_t>(heaviest - particles_.begin());
}

// Systematic resampling when the effective number of particles is low.
void GridSlam::resample_if_needed() {
  const std::vector<double> weights = this->weights();
  double squares = 0.0;
  for (const double weight : weights) squares += weight * weight;
  const auto count = static_cast<double>(particles_.size());
  if (1.0 / squares >= options_.resample_threshold * count) return;
  std::vector<Particle> drawn;
  double place = random_.uniform() / count, sum = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    sum += weights[i];
    for (; place < sum && drawn.size() < particles_.size(); place += 1.0 / count) drawn.push_back(particles_[i]);
  }
  while (drawn.size() < particles_.size()) drawn.push_back(particles_.back());
  for (Particle& particle : drawn) particle.log_weight = 0.0;
  particles_ = std::move(drawn);
}

void GridSlam::register_scan() {
  const std::vector<BeamEnd> beams = beam_ends();
  for (Particle& particle : particles_) {
    particle.expected = particle.pose;
    nodes_.push_back({particle.pose, particle.node, static_cast<int>(scans_.size()) - 1});
    particle.node = static_cast<int>(nodes_.size()) - 1;
    const double c = std::cos(particle.pose.yaw), s = std::sin(particle.pose.yaw);
    for (const BeamEnd& beam : beams) {
      const double x = particle.pose.x + c * beam.x - s * beam.y, y = particle.pose.y + s * beam.x + c * beam.y;
      if (!particle.map.reaches(x) || !particle.map.reaches(y)) continue;
      const int column = particle.map.cell_of(x), row = particle.map.cell_of(y);
      Hits& hits = particle.map.at(column, row);
      hits.x += static_cast<float>(x - particle.map.corner(column));
      hits.y += static_cast<float>(y - particle.map.corner(row));
      ++hits.count;
    }
  }
}

void GridSlam::count(const Node& node) {
  const auto& ranges = scans_[static_cast<std::size_t>(node.scan)];
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double range = double{ranges[i]};
    if (range == 0.0 || range == kNoHit) continue;
    const double angle = node.pose.yaw + bearings_[i];
    const Beam beam{node.pose.x, node.pose.y, std::cos(angle), std::sin(angle)};
    counts_.add(beam, std::min(range, options_.usable_range), range <= options_.usable_range);
  }
}

// Counts what the best particle's trajectory has and counts_ has not yet.
void GridSlam::count_new() {
  const int last = particles_[best()].node;
  std::vector<int> path;  // back to what is counted already
  int node = last;
  for (; node >= 0 && node != counted_node_; node = nodes_[static_cast<std::size_t>(node)].parent) path.push_back(node);
  if (node < 0) counts_ = CellCounts(options_.delta);
  for (auto place = path.rbegin(); place != path.rend(); ++place) count(nodes_[static_cast<std::size_t>(*place)]);
  counted_node_ = last;
}

SeenCells GridSlam::seen() {
  count_new();
  return counts_.seen();
}

std::vector<std::int8_t> GridSlam::draw(const MapFrame& frame) {
  count_new();
  return counts_.draw(frame);
}

}  // namespace trundle::navigation
