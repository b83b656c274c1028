#include "particle_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "pose_bins.h"

namespace trundle::navigation {

namespace {

constexpr double kConvergedDistance = 0.5;  // [m]; amcl's
constexpr double kTogetherDistance = 1.5;   // [m]
constexpr double kCloseDistance = 0.2;      // [m]
// A set of max_particles would miss the pose in a large map: this many more are drawn, and the first scan reduces them.
constexpr int kCandidatesPerParticle = 10, kMaxCandidates = 200'000;
constexpr double kScanExponent = 6.0;
constexpr double kAgreeingShare = 0.8;
constexpr double kGoldenRatio = 0.6180339887498949;

// Lower triangular root of a covariance; directions without variance have none.
std::array<double, 9> cholesky(const std::array<double, 9>& covariance) {
  std::array<double, 9> root{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column <= row; ++column) {
      double rest = covariance[3 * row + column];
      for (std::size_t k = 0; k < column; ++k) rest -= root[3 * row + k] * root[3 * column + k];
      const double diagonal = root[3 * column + column];
      if (row == column) root[3 * row + column] = std::sqrt(std::max(0.0, rest));
      else root[3 * row + column] = diagonal > 0.0 ? rest / diagonal : 0.0;
    }
  return root;
}

// Number of particles with which, with probability kld_z, the divergence is below kld_err. amcl takes kld_z itself for
// the quantile of the normal distribution.
int needed_particles(const FilterOptions& options, int bins) {
  if (bins <= 1) return options.max_particles;
  const double b = 2.0 / (9.0 * (bins - 1));
  const double x = 1.0 - b + std::sqrt(b) * options.kld_z;
  const double count = std::ceil((bins - 1) / (2.0 * options.kld_err) * x * x * x);
  return static_cast<int>(
      std::clamp(count, static_cast<double>(options.min_particles), static_cast<double>(options.max_particles)));
}

// Weighted sums of poses.
struct Moments {
  double weight = 0.0, x = 0.0, y = 0.0, c = 0.0, s = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(const Particle& particle) {
    const auto& [pose, w] = particle;
    weight += w;
    x += w * pose.x;
    y += w * pose.y;
    c += w * std::cos(pose.yaw);
    s += w * std::sin(pose.yaw);
    xx += w * pose.x * pose.x;
    xy += w * pose.x * pose.y;
    yy += w * pose.y * pose.y;
  }

  PlanarPose mean() const { return {x / weight, y / weight, std::atan2(s, c)}; }

  std::array<double, 9> covariance() const {
    const double mean_x = x / weight, mean_y = y / weight;
    const double length = std::clamp(std::hypot(c, s) / weight, std::numeric_limits<double>::min(), 1.0);
    const double across = xy / weight - mean_x * mean_y;
    return {std::max(0.0, xx / weight - mean_x * mean_x),
            across,
            0.0,
            across,
            std::max(0.0, yy / weight - mean_y * mean_y),
            0.0,
            0.0,
            0.0,
            -2.0 * std::log(length)};
  }
};

}  // namespace

ParticleFilter::ParticleFilter(const FilterOptions& options, std::shared_ptr<const OccupancyMap> map,
                               std::uint64_t seed)
    : options_(options), map_(std::move(map)), random_(seed) {
  for (std::size_t cell = 0; cell < map_->cells.size(); ++cell)
    if (map_->cells[cell] == 0) free_cells_.push_back(static_cast<std::int32_t>(cell));
}

void ParticleFilter::spread(const PlanarPose& mean, const std::array<double, 9>& covariance) {
  const auto root = cholesky(covariance);
  slow_average_ = fast_average_ = 0.0;
  particles_.clear();
  for (int i = 0; i < options_.max_particles; ++i) {
    const std::array<double, 3> normal{random_.gaussian(1.0), random_.gaussian(1.0), random_.gaussian(1.0)};
    const PlanarPose pose{mean.x + root[0] * normal[0], mean.y + root[3] * normal[0] + root[4] * normal[1],
                          mean.yaw + root[6] * normal[0] + root[7] * normal[1] + root[8] * normal[2]};
    particles_.push_back({{pose.x, pose.y, normalized_angle(pose.yaw)}, 1.0 / options_.max_particles});
  }
}

void ParticleFilter::spread_over_map() {
  slow_average_ = fast_average_ = 0.0;
  particles_.clear();
  const auto wanted =
      std::min<std::int64_t>(std::int64_t{kCandidatesPerParticle} * options_.max_particles, kMaxCandidates);
  const auto count = std::max<std::int64_t>(wanted, options_.max_particles);
  for (std::int64_t i = 0; i < count; ++i) particles_.push_back({random_pose(), 1.0 / static_cast<double>(count)});
}

PlanarPose ParticleFilter::random_pose() {
  const double yaw = (2.0 * random_.uniform() - 1.0) * std::numbers::pi;
  if (free_cells_.empty()) return {map_->origin_x, map_->origin_y, yaw};
  const auto index = static_cast<std::size_t>(random_.uniform() * static_cast<double>(free_cells_.size()));
  const int column = free_cells_[index] % map_->width, row = free_cells_[index] / map_->width;
  return {map_->origin_x + (column + 0.5) * map_->resolution, map_->origin_y + (row + 0.5) * map_->resolution, yaw};
}

bool ParticleFilter::has_converged() const {
  double x = 0.0, y = 0.0;
  for (const auto& particle : particles_) {
    x += particle.pose.x / static_cast<double>(particles_.size());
    y += particle.pose.y / static_cast<double>(particles_.size());
  }
  return std::all_of(particles_.begin(), particles_.end(), [x, y](const Particle& particle) {
    return std::abs(particle.pose.x - x) <= kConvergedDistance && std::abs(particle.pose.y - y) <= kConvergedDistance;
  });
}

// True if most particles are near their median: a few random ones, of the recovery or of the first spread, do not
// matter.
bool ParticleFilter::has_agreed(double distance) const {
  std::vector<double> x, y;
  for (const auto& [pose, weight] : particles_) {
    if (!std::isfinite(pose.x) || !std::isfinite(pose.y)) return false;
    x.push_back(pose.x);
    y.push_back(pose.y);
  }
  const auto middle = static_cast<std::ptrdiff_t>(particles_.size() / 2);
  std::nth_element(x.begin(), x.begin() + middle, x.end());
  std::nth_element(y.begin(), y.begin() + middle, y.end());
  const double middle_x = *(x.begin() + middle), middle_y = *(y.begin() + middle);
  const auto near = std::count_if(particles_.begin(), particles_.end(), [=](const Particle& particle) {
    return std::abs(particle.pose.x - middle_x) <= distance && std::abs(particle.pose.y - middle_y) <= distance;
  });
  return static_cast<double>(near) >= kAgreeingShare * static_cast<double>(particles_.size());
}

void ParticleFilter::weigh(LaserModel& model, const LaserScan& scan) {
  std::vector<double> before;
  for (const auto& particle : particles_) before.push_back(particle.weight);
  if (particles_.empty()) return;
  const bool has_agreed_before = has_agreed(kConvergedDistance);
  const Agreement agreement{has_converged(), has_agreed(kTogetherDistance), has_agreed(kCloseDistance)};
  const auto log_scale = model.weigh(particles_, scan, agreement);
  if (!log_scale) return;
  double total = 0.0;
  for (const auto& particle : particles_) total += particle.weight;
  if (!(total > 0.0)) {
    for (auto& particle : particles_) particle.weight = 1.0 / static_cast<double>(particles_.size());
    return;
  }
  for (auto& particle : particles_) particle.weight /= total;
  const double likelihood = total * std::exp(*log_scale);
  slow_average_ =
      slow_average_ == 0.0 ? likelihood : slow_average_ + options_.alpha_slow * (likelihood - slow_average_);
  fast_average_ =
      fast_average_ == 0.0 ? likelihood : fast_average_ + options_.alpha_fast * (likelihood - fast_average_);
  const bool has_candidates = particles_.size() > static_cast<std::size_t>(options_.max_particles);
  if ((has_agreed_before || has_candidates) && !model.is_sharp()) sharpen(before);
  if (has_candidates) draw();
}

// Counts the last scan several times. amcl's sum over a scan's beams tells little: a pose 0.1 m off is taken for three
// quarters as likely, so that particles follow an odometry that is wrong by a few percent, and of the candidates all
// over a map those near the robot are hardly kept more often than others.
void ParticleFilter::sharpen(const std::vector<double>& before) {
  double total = 0.0;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    double& weight = particles_[i].weight;
    if (weight > 0.0) weight = before[i] * std::pow(weight / before[i], kScanExponent);
    total += weight;
  }
  for (auto& particle : particles_) particle.weight /= total;
}

void ParticleFilter::resample() {
  double squares = 0.0;
  for (const auto& particle : particles_) squares += particle.weight * particle.weight;
  if (options_.selective_resampling && squares * static_cast<double>(particles_.size()) < 2.0) return;
  draw();
}

void ParticleFilter::draw() {
  std::vector<double> sums{0.0};
  for (const auto& particle : particles_) sums.push_back(sums.back() + particle.weight);
  const double random_share = slow_average_ > 0.0 ? std::max(0.0, 1.0 - fast_average_ / slow_average_) : 0.0;
  std::vector<Particle> drawn;
  PoseBins bins;
  // The first numbers of this sequence are evenly distributed over [0, 1), however many particles are drawn.
  double place = random_.uniform();
  while (static_cast<int>(drawn.size()) < options_.max_particles) {
    PlanarPose pose;
    if (random_share > 0.0 && random_.uniform() < random_share) {
      pose = random_pose();
    } else {
      place += kGoldenRatio;
      if (place >= 1.0) place -= 1.0;
      const auto above = std::upper_bound(sums.begin() + 1, sums.end() - 1, place * sums.back());
      pose = particles_[static_cast<std::size_t>(above - sums.begin() - 1)].pose;
    }
    drawn.push_back({pose, 0.0});
    bins.add(pose);
    if (static_cast<int>(drawn.size()) >= needed_particles(options_, bins.count())) break;
  }
  for (auto& particle : drawn) particle.weight = 1.0 / static_cast<double>(drawn.size());
  particles_ = std::move(drawn);
  if (random_share > 0.0) slow_average_ = fast_average_ = 0.0;  // otherwise more and more random particles would follow
}

Estimate ParticleFilter::estimate() const {
  PoseBins bins;
  std::vector<std::size_t> numbers;
  for (const auto& particle : particles_) numbers.push_back(static_cast<std::size_t>(bins.add(particle.pose)));
  const std::vector<int> clusters = bins.clusters();
  std::vector<Moments> moments(clusters.size());
  Moments all;
  for (std::size_t i = 0; i < particles_.size(); ++i) {
    moments[static_cast<std::size_t>(clusters[numbers[i]])].add(particles_[i]);
    all.add(particles_[i]);
  }
  const auto heaviest = std::max_element(moments.begin(), moments.end(),
                                         [](const Moments& a, const Moments& b) { return a.weight < b.weight; });
  return {heaviest->mean(), all.covariance()};
}

}  // namespace trundle::navigation
