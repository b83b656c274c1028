#include "pose_graph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "block_cholesky.h"
#include "symmetric_solve.h"

namespace trundle::navigation {

namespace {

constexpr int kMaxIterations = 50;
constexpr double kEnough = 1e-6;  // relative decrease of the error that ends the search
constexpr double kFirstDamping = 1e-6, kMinDamping = 1e-12, kMaxDamping = 1e9;

Triple difference(const PlanarPose& from, const PlanarPose& to, const PlanarPose& motion) {
  const PlanarPose estimated = compose(inverse(from), to);
  return {estimated.x - motion.x, estimated.y - motion.y, angle_difference(estimated.yaw, motion.yaw)};
}

double squared(const Triple& e, const std::array<double, 6>& information) {
  const Triple weighted = symmetric_product(information, e);
  return e[0] * weighted[0] + e[1] * weighted[1] + e[2] * weighted[2];
}

Block full(const std::array<double, 6>& m) { return {m[0], m[1], m[3], m[1], m[2], m[4], m[3], m[4], m[5]}; }

Block product(const Block& a, const Block& b) {
  Block c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[3 * i + j] += a[3 * i + k] * b[3 * k + j];
  return c;
}

// aᵀ b
Block transposed_product(const Block& a, const Block& b) {
  return product({a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]}, b);
}

void add(Block& sum, const Block& term) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += term[i];
}

// sum -= aᵀ v
void subtract_transposed(Triple& sum, const Block& a, const Triple& v) {
  for (std::size_t i = 0; i < 3; ++i) sum[i] -= a[i] * v[0] + a[3 + i] * v[1] + a[6 + i] * v[2];
}

// The linearized system of all nodes but the first.
class System {
 public:
  explicit System(const PoseGraph& graph) : graph_(graph), count_(static_cast<int>(graph.poses.size()) - 1) {
    for (const Constraint& constraint : graph.constraints) {
      const std::pair<int, int> key = std::minmax(constraint.from, constraint.to);
      if (key.first > 0) number_.emplace(std::pair{key.first - 1, key.second - 1}, 0);
    }
    std::vector<std::pair<int, int>> pairs;
    for (auto& [pair, number] : number_) {
      number = pairs.size();
      pairs.push_back(pair);
    }
    cholesky_.emplace(count_, std::move(pairs));
  }

  void linearize(const std::vector<PlanarPose>& poses) {
    diagonal_.assign(static_cast<std::size_t>(count_), Block{});
    beside_.assign(number_.size(), Block{});
    right_.assign(static_cast<std::size_t>(count_), Triple{});
    for (const Constraint& constraint : graph_.constraints) add_constraint(constraint, poses);
  }

  // Steps of the nodes but the first; false where none is found.
  bool solve(double damping, std::vector<Triple>& steps) {
    std::vector<Block> damped = diagonal_;
    for (Block& block : damped)
      for (const std::size_t i : {0, 4, 8}) block[i] += damping * std::max(block[i], 1.0);
    steps = right_;
    return cholesky_->solve(damped, beside_, steps);
  }

 private:
  void add_constraint(const Constraint& constraint, const std::vector<PlanarPose>& poses) {
    const PlanarPose& from = poses[static_cast<std::size_t>(constraint.from)];
    const PlanarPose& to = poses[static_cast<std::size_t>(constraint.to)];
    const double c = std::cos(from.yaw), s = std::sin(from.yaw), dx = to.x - from.x, dy = to.y - from.y;
    const Block by_from{-c, -s, -s * dx + c * dy, s, -c, -c * dx - s * dy, 0.0, 0.0, -1.0};
    const Block by_to{c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0};
    const Block information = full(constraint.information);
    const Triple weighted = symmetric_product(constraint.information, difference(from, to, constraint.motion));
    const int i = constraint.from - 1, j = constraint.to - 1;
    if (i >= 0) {
      add(diagonal_[static_cast<std::size_t>(i)], transposed_product(by_from, product(information, by_from)));
      subtract_transposed(right_[static_cast<std::size_t>(i)], by_from, weighted);
    }
    if (j >= 0) {
      add(diagonal_[static_cast<std::size_t>(j)], transposed_product(by_to, product(information, by_to)));
      subtract_transposed(right_[static_cast<std::size_t>(j)], by_to, weighted);
    }
    if (i < 0 || j < 0) return;
    const std::pair<int, int> key = std::minmax(i, j);
    const auto& [first, second] = i < j ? std::pair{by_from, by_to} : std::pair{by_to, by_from};
    add(beside_[number_.at(key)], transposed_product(first, product(information, second)));
  }

  const PoseGraph& graph_;
  int count_;
  std::map<std::pair<int, int>, std::size_t> number_;  // of a block beside the diagonal
  std::optional<BlockCholesky> cholesky_;
  std::vector<Block> diagonal_, beside_;
  std::vector<Triple> right_;
};

double error_of(const std::vector<Constraint>& constraints, const std::vector<PlanarPose>& poses) {
  double sum = 0.0;
  for (const Constraint& constraint : constraints)
    sum += squared(difference(poses[static_cast<std::size_t>(constraint.from)],
                              poses[static_cast<std::size_t>(constraint.to)], constraint.motion),
                   constraint.information);
  return sum;
}

}  // namespace

double PoseGraph::error() const { return error_of(constraints, poses); }

double PoseGraph::optimize() {
  double least = error();
  if (poses.size() < 2) return least;
  System system(*this);
  double damping = kFirstDamping;
  std::vector<Triple> steps;
  for (int iteration = 0; iteration < kMaxIterations && damping < kMaxDamping; ++iteration) {
    system.linearize(poses);
    double next = least;
    std::vector<PlanarPose> moved;
    while (damping < kMaxDamping) {
      moved = poses;
      if (system.solve(damping, steps)) {
        for (std::size_t i = 0; i < steps.size(); ++i) {
          PlanarPose& pose = moved[i + 1];
          pose = {pose.x + steps[i][0], pose.y + steps[i][1], normalized_angle(pose.yaw + steps[i][2])};
        }
        next = error_of(constraints, moved);
        if (next <= least) break;  // never, if it is not a number
      }
      damping = std::max(damping, 1e-6) * 10.0;
    }
    if (!(next <= least)) break;
    const double decrease = least - next;
    poses = std::move(moved);
    least = next;
    damping = std::max(damping * 0.1, kMinDamping);
    if (decrease <= kEnough * least + 1e-12) break;
  }
  return least;
}

std::array<double, 6> turned(const std::array<double, 6>& m, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * c * m[0] - 2.0 * c * s * m[1] + s * s * m[2],
          c * s * (m[0] - m[2]) + (c * c - s * s) * m[1],
          s * s * m[0] + 2.0 * c * s * m[1] + c * c * m[2],
          c * m[3] - s * m[4],
          s * m[3] + c * m[4],
          m[5]};
}

}  // namespace trundle::navigation
