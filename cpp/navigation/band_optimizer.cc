#include "band_optimizer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "band_terms.h"
#include "banded_system.h"

namespace trundle::navigation {

namespace {

constexpr std::size_t kWidth = 3 * kPerPose - 1;
constexpr double kShortestStep = 1e-3;  // [s]
constexpr double kLeastDiagonal = 1e-6;

struct Link {  // an obstacle or a point to pass, and the pose that it acts on
  std::size_t pose;
  Point point;
};

// Sum of the weighted squares.
struct CostSink {
  template <std::size_t>
  using Number = Dual<0>;

  double cost = 0.0;

  void add(std::size_t, const Dual<0>& residual, double weight) { cost += weight * residual.value * residual.value; }
};

// The sum, its gradient, and the normal equations.
struct NormalSink {
  template <std::size_t N>
  using Number = Dual<N>;

  BandedSystem& system;
  std::vector<double>& gradient;
  std::size_t last_pose;

  [[nodiscard]] bool is_fixed(std::size_t unknown) const {
    const std::size_t pose = unknown / kPerPose;
    return unknown % kPerPose != 3 && (pose == 0 || pose == last_pose);
  }

  template <std::size_t N>
  void add(std::size_t first, const Dual<N>& residual, double weight) {
    const std::size_t base = kPerPose * first;
    for (std::size_t i = 0; i < N; ++i) {
      if (residual.slope[i] == 0.0 || is_fixed(base + i)) continue;
      const double scaled = weight * residual.slope[i];
      gradient[base + i] += scaled * residual.value;
      for (std::size_t j = 0; j <= i; ++j)
        if (!is_fixed(base + j)) system.at(base + i, base + j) += scaled * residual.slope[j];
    }
  }
};

class Optimizer {
 public:
  Optimizer(TimedBand& band, const BandSettings& settings, const BandScene& scene)
      : band_(band), s_(settings), scene_(scene) {}

  double run(double obstacle_scale) {
    obstacle_weight_ = 1.0;
    for (int outer = 0; outer < s_.no_outer_iterations; ++outer) {
      if (s_.teb_autosize) band_.resize(s_);
      link();
      iterate();
      obstacle_weight_ *= s_.weight_adapt_factor;
    }
    obstacle_weight_ = obstacle_scale;
    return cost();
  }

 private:
  // Relevant obstacles of each pose: all that are near, else the nearest on each side.
  void link() {
    obstacles_.clear();
    passed_.clear();
    const double near = s_.min_obstacle_dist * s_.obstacle_association_force_inclusion_factor;
    const double far = s_.min_obstacle_dist * s_.obstacle_association_cutoff_factor;
    for (std::size_t i = 1; i + 1 < band_.poses.size(); ++i) {
      const BandPose& pose = band_.poses[i];
      std::array<double, 2> least{far, far};
      std::array<const Point*, 2> nearest{};
      for (const Point& point : scene_.obstacles) {
        const double dx = point[0] - pose[0], dy = point[1] - pose[1], most = far + scene_.body.reach();
        if (dx * dx + dy * dy > most * most) continue;
        const double distance = scene_.body.distance(pose, point).distance;
        if (distance < near) {
          obstacles_.push_back({i, point});
          continue;
        }
        const std::size_t side = std::cos(pose[2]) * dy > std::sin(pose[2]) * dx ? 0 : 1;
        if (distance < least[side]) {
          least[side] = distance;
          nearest[side] = &point;
        }
      }
      for (const Point* point : nearest)
        if (point != nullptr) obstacles_.push_back({i, *point});
    }
    for (const Point& point : scene_.via_points) {
      const auto distance = [&](const BandPose& pose) { return std::hypot(pose[0] - point[0], pose[1] - point[1]); };
      const auto nearest = std::min_element(band_.poses.begin(), band_.poses.end(),
                                            [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
      passed_.push_back({static_cast<std::size_t>(nearest - band_.poses.begin()), point});
    }
  }

  template <typename Sink>
  void add_terms(Sink& sink) const {
    using Number = typename Sink::template Number<kPerPose>;
    BandTerms<Sink>(band_, s_, scene_.velocity, sink).add();
    const double buffer = s_.inflation_dist, least = s_.min_obstacle_dist;
    for (const Link& link : obstacles_) {
      const BodyDistance found = scene_.body.distance(band_.poses[link.pose], link.point);
      Number distance(found.distance);
      for (std::size_t k = 0; k < std::min<std::size_t>(3, distance.slope.size()); ++k)
        distance.slope[k] = found.slope[k];
      Number lack = below(distance, least + s_.penalty_epsilon);
      if (s_.obstacle_cost_exponent != 1.0 && least > 0.0 && lack.value > 0.0) {
        const double power = std::pow(lack.value / least, s_.obstacle_cost_exponent);
        lack = lack.mapped(least * power, s_.obstacle_cost_exponent * power * least / lack.value);
      }
      sink.add(link.pose, lack, obstacle_weight_ * s_.weight_obstacle);
      if (buffer > least) sink.add(link.pose, below(distance, buffer), obstacle_weight_ * s_.weight_inflation);
    }
    for (const Link& link : passed_) {
      Number x(band_.poses[link.pose][0] - link.point[0]), y(band_.poses[link.pose][1] - link.point[1]);
      if (x.slope.size() > 1) x.slope[0] = y.slope[1] = 1.0;
      sink.add(link.pose, x, s_.weight_viapoint);
      sink.add(link.pose, y, s_.weight_viapoint);
    }
  }

  [[nodiscard]] double cost() const {
    CostSink sink;
    add_terms(sink);
    return std::isfinite(sink.cost) ? sink.cost : std::numeric_limits<double>::infinity();
  }

  void iterate() {
    const std::size_t count = kPerPose * band_.poses.size();
    BandedSystem system(count, kWidth);
    std::vector<double> gradient(count), change(count);
    double present = cost(), damping = 1e-3;
    for (int inner = 0; inner < s_.no_inner_iterations; ++inner) {
      system.clear();
      std::fill(gradient.begin(), gradient.end(), 0.0);
      NormalSink sink{system, gradient, band_.poses.size() - 1};
      add_terms(sink);
      for (std::size_t i = 0; i < count; ++i) system.at(i, i) += kLeastDiagonal;
      bool is_better = false;
      for (int attempt = 0; attempt < 12 && !is_better; ++attempt) {
        if (system.solve(gradient, damping, change)) {
          const TimedBand before = band_;
          step(change);
          const double next = cost();
          if (next < present) {
            is_better = true;
            present = next;
          } else {
            band_ = before;
          }
        }
        damping = is_better ? std::max(0.2 * damping, 1e-9) : 8.0 * damping;
      }
      if (!is_better) return;
    }
  }

  void step(const std::vector<double>& change) {
    for (std::size_t i = 0; i < band_.poses.size(); ++i) {
      BandPose& pose = band_.poses[i];
      for (std::size_t k = 0; k < 3; ++k) pose[k] -= change[kPerPose * i + k];
      pose[2] = angle_between(0.0, pose[2]);
      if (i < band_.steps.size()) band_.steps[i] = std::max(band_.steps[i] - change[kPerPose * i + 3], kShortestStep);
    }
  }

  TimedBand& band_;
  const BandSettings& s_;
  const BandScene& scene_;
  double obstacle_weight_ = 1.0;
  std::vector<Link> obstacles_, passed_;
};

}  // namespace

double optimize_band(TimedBand& band, const BandSettings& settings, const BandScene& scene, double obstacle_scale) {
  return Optimizer(band, settings, scene).run(obstacle_scale);
}

}  // namespace trundle::navigation
