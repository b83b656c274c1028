#include "pose_solver.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "manipulability.h"

namespace trundle::planning {

namespace {

constexpr int kMaxSteps = 40;             // of one attempt
constexpr int kCandidates = 6;            // random states of which a restart takes the best
constexpr int kEnough = 20;               // solutions in a row that improve nothing end the search for a better one
constexpr double kExact = 1e-9;           // error below which nothing is gained [m], [rad]
constexpr double kLongestStep = 1.2;      // of one joint [rad], [m]
constexpr double kUnboundedTravel = 1.0;  // half the range in which unbounded prismatic joints are sampled [m]
constexpr double kFarthest = 1e6;         // value of a state that counts [rad], [m]
constexpr std::int64_t kCheckCost = 20;   // iterations that a check counts as

using Columns = std::array<double, kMaxColumns>;

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  double uniform() {  // splitmix64 (Vigna); in [0, 1)
    state_ += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

std::uint64_t mix(std::uint64_t hash, double value) {
  hash ^= std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value);
  hash *= 0x100000001b3U;
  return hash ^ (hash >> 29);
}

// Solve the system a x = b of a symmetric positive definite matrix (Cholesky); a is destroyed.
template <std::size_t M>
void solve_symmetric(std::array<double, M * M>& a, std::array<double, M>& b) {
  for (std::size_t j = 0; j < M; ++j) {
    double pivot = a[j * M + j];
    for (std::size_t k = 0; k < j; ++k) pivot -= a[j * M + k] * a[j * M + k];
    const double inverse = 1.0 / std::sqrt(std::max(pivot, 1e-300));
    a[j * M + j] = inverse;
    for (std::size_t i = j + 1; i < M; ++i) {
      double sum = a[i * M + j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i * M + k] * a[j * M + k];
      a[i * M + j] = sum * inverse;
    }
  }
  for (std::size_t i = 0; i < M; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * M + k] * b[k];
    b[i] *= a[i * M + i];
  }
  for (std::size_t i = M; i-- > 0;) {
    for (std::size_t k = i + 1; k < M; ++k) b[i] -= a[k * M + i] * b[k];
    b[i] *= a[i * M + i];
  }
}

// One request: M is 6, or 3 where only the position counts.
template <std::size_t M>
class Search {
 public:
  Search(const JointChain& chain, const PoseSolverOptions& options, double length, const PoseRequest& request)
      : chain_(chain), options_(options), length_(length), request_(request), random_(hash_of(request, options)) {
    chain.hold(request.state, held_);
    state_.assign(request.state.begin(), request.state.end());
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const ChainColumn& column = chain.columns()[i];
      double start = state_[static_cast<std::size_t>(column.variable)];
      if (!(std::abs(start) < kFarthest)) start = 0.0;
      start_[i] = start;
      double low = column.lower, high = column.upper;
      if (!column.is_bounded) {
        const double half = column.is_angle ? std::numbers::pi : kUnboundedTravel;
        low = start - half, high = start + half;
      }
      limits_low_[i] = column.is_bounded ? low : -std::numeric_limits<double>::infinity();
      limits_high_[i] = column.is_bounded ? high : std::numeric_limits<double>::infinity();
      if (!request.tolerances.empty()) {
        low = std::max(low, start - request.tolerances[i]), high = std::min(high, start + request.tolerances[i]);
        limits_low_[i] = std::max(limits_low_[i], start - request.tolerances[i]);
        limits_high_[i] = std::min(limits_high_[i], start + request.tolerances[i]);
      }
      sample_low_[i] = low, sample_high_[i] = high;
    }
  }

  PoseSolution run() {
    best_.columns.assign(start_.begin(), start_.begin() + static_cast<std::ptrdiff_t>(chain_.size()));
    for (std::size_t i = 0; i < chain_.size(); ++i)
      if (limits_low_[i] > limits_high_[i]) return std::move(best_);
    double smallest = std::numeric_limits<double>::infinity(), value = smallest;
    int since_better = 0;
    while (best_.iterations < request_.iterations || best_.attempts == 0) {
      best_.attempts == 0 ? begin_at_start() : begin_anywhere();
      ++best_.attempts;
      const bool is_solved = descend();
      if (!is_solved && !best_.is_found && cost_ < smallest) {
        smallest = cost_;
        take();
      }
      if (!is_solved) continue;
      unwind();
      if (!is_accepted()) {
        ++best_.refused;
        continue;
      }
      const double worth = worth_of();
      if (!best_.is_found || worth < value) {
        value = worth;
        since_better = 0;
        best_.is_found = true;
        take();
      } else if (++since_better >= kEnough) {
        break;
      }
      if (options_.type == SolveType::kSpeed) break;
    }
    return std::move(best_);
  }

 private:
  static std::uint64_t hash_of(const PoseRequest& request, const PoseSolverOptions& options) {
    std::uint64_t hash = 0xcbf29ce484222325U + options.seed;
    for (const double value : request.target.r.m) hash = mix(hash, value);
    for (const double value : {request.target.p.x, request.target.p.y, request.target.p.z}) hash = mix(hash, value);
    return hash;
  }

  double evaluate(const Columns& q, JointChain::Pose& pose, std::array<double, M>& error) const {
    chain_.place(q.data(), held_.data(), pose);
    const Vec3 offset = request_.target.p - pose.tip.p;
    error[0] = offset.x, error[1] = offset.y, error[2] = offset.z;
    if constexpr (M == 6) {
      const Vec3 turn = length_ * rotation_vector(request_.target.r * transpose(pose.tip.r));
      error[3] = turn.x, error[4] = turn.y, error[5] = turn.z;
    }
    double sum = 0.0;
    for (const double value : error) sum += value * value;
    return 0.5 * sum;
  }

  bool is_within(const std::array<double, M>& error, double epsilon) const {
    for (std::size_t i = 0; i < M; ++i)
      if (!(std::abs(error[i]) <= (i < 3 ? epsilon : length_ * epsilon))) return false;
    return true;
  }

  void begin_at_start() {
    for (std::size_t i = 0; i < chain_.size(); ++i) q_[i] = std::clamp(start_[i], limits_low_[i], limits_high_[i]);
    cost_ = evaluate(q_, pose_, error_);
  }

  void begin_anywhere() {
    cost_ = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kCandidates; ++k) {
      for (std::size_t i = 0; i < chain_.size(); ++i)
        trial_[i] = sample_low_[i] + random_.uniform() * (sample_high_[i] - sample_low_[i]);
      const double cost = evaluate(trial_, trial_pose_, trial_error_);
      if (cost < cost_) accept(cost);
    }
    best_.iterations += kCandidates / 4;
  }

  void accept(double cost) {
    cost_ = cost;
    std::swap(q_, trial_);
    std::swap(pose_, trial_pose_);
    std::swap(error_, trial_error_);
  }

  // Reduce the error until it is small enough; false: it does not become so from here.
  bool descend() {
    double damping = 1.0;
    bool has_solved = is_within(error_, options_.epsilon);
    double mark = cost_;
    for (int step = 0; step < kMaxSteps; ++step) {
      if (has_solved && is_within(error_, kExact)) break;
      ++best_.iterations;
      chain_.jacobian(pose_, jacobian_.data());
      if constexpr (M == 6)
        for (std::size_t i = 3 * chain_.size(); i < 6 * chain_.size(); ++i) jacobian_[i] *= length_;
      bool is_better = false;
      for (int tries = 0; tries < 4 && !is_better; ++tries) {
        find_step(damping * cost_ + 1e-12);
        const double cost = evaluate(trial_, trial_pose_, trial_error_);
        is_better = cost < cost_;
        if (is_better) accept(cost);
        damping = is_better ? std::max(damping * 0.5, 0.05) : damping * 6.0;
      }
      if (is_within(error_, options_.epsilon)) {
        if (has_solved) break;
        has_solved = true;
        continue;
      }
      if (!is_better) break;
      if (step % 4 == 3) {  // a local minimum: the error hardly becomes smaller
        if (cost_ > 0.7 * mark) break;
        mark = cost_;
      }
    }
    return has_solved;
  }

  // The next state, by damped least squares over the columns that their limits do not stop.
  void find_step(double damping) {
    const std::size_t n = chain_.size();
    std::array<bool, kMaxColumns> is_stopped{};
    for (int pass = 0; pass < 4; ++pass) {
      std::array<double, M * M> a{};
      for (std::size_t row = 0; row < M; ++row) {
        for (std::size_t column = 0; column <= row; ++column) {
          double sum = row == column ? damping : 0.0;
          for (std::size_t i = 0; i < n; ++i)
            if (!is_stopped[i]) sum += jacobian_[row * n + i] * jacobian_[column * n + i];
          a[row * M + column] = sum;
        }
      }
      std::array<double, M> b = error_;
      solve_symmetric<M>(a, b);
      bool is_stopping = false;
      double longest = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        double step = 0.0;
        if (!is_stopped[i])
          for (std::size_t row = 0; row < M; ++row) step += jacobian_[row * n + i] * b[row];
        if ((step < 0.0 && q_[i] <= limits_low_[i]) || (step > 0.0 && q_[i] >= limits_high_[i])) {
          is_stopped[i] = is_stopping = true;
          step = 0.0;
        }
        step_[i] = step;
        longest = std::max(longest, std::abs(step));
      }
      const double share = longest > kLongestStep ? kLongestStep / longest : 1.0;
      for (std::size_t i = 0; i < n; ++i)
        trial_[i] = std::clamp(q_[i] + share * step_[i], limits_low_[i], limits_high_[i]);
      if (!is_stopping) break;
    }
  }

  // Take whole turns off, towards the start.
  void unwind() {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    for (std::size_t i = 0; i < chain_.size(); ++i) {
      if (!chain_.columns()[i].is_angle) continue;
      double near = q_[i] - kTurn * std::round((q_[i] - start_[i]) / kTurn);
      if (near > limits_high_[i]) near -= kTurn * std::ceil((near - limits_high_[i]) / kTurn);
      if (near < limits_low_[i]) near += kTurn * std::ceil((limits_low_[i] - near) / kTurn);
      if (near <= limits_high_[i]) q_[i] = near;
    }
  }

  bool is_accepted() {
    for (std::size_t i = 0; i < chain_.size(); ++i)
      if (!(q_[i] >= limits_low_[i] && q_[i] <= limits_high_[i])) return false;
    if (request_.check == nullptr) return true;
    best_.iterations += kCheckCost;
    for (std::size_t i = 0; i < chain_.size(); ++i)
      state_[static_cast<std::size_t>(chain_.columns()[i].variable)] = q_[i];
    return request_.check->is_valid(state_.data());
  }

  // Smaller is better.
  double worth_of() {
    if (options_.type == SolveType::kSpeed) return 0.0;
    const std::size_t n = chain_.size();
    if (options_.type == SolveType::kDistance) {
      double sum = 0.0;
      for (std::size_t i = 0; i < n; ++i) sum += (q_[i] - start_[i]) * (q_[i] - start_[i]);
      return sum;
    }
    chain_.place(q_.data(), held_.data(), pose_);
    chain_.jacobian(pose_, jacobian_.data());
    const auto [volume, ratio] = manipulability(jacobian_.data(), n, M);
    return options_.type == SolveType::kManipulability ? -volume : -ratio;
  }

  void take() {
    std::copy_n(q_.begin(), chain_.size(), best_.columns.begin());
    double position = 0.0, rotation = 0.0;
    for (std::size_t i = 0; i < M; ++i) (i < 3 ? position : rotation) += error_[i] * error_[i];
    best_.position_error = std::sqrt(position);
    best_.rotation_error = std::sqrt(rotation) / length_;
  }

  const JointChain& chain_;
  const PoseSolverOptions& options_;
  double length_;
  const PoseRequest& request_;
  Random random_;
  PoseSolution best_;
  std::vector<double> state_;
  std::array<double, kMaxChainJoints> held_{};
  Columns start_{}, limits_low_{}, limits_high_{}, sample_low_{}, sample_high_{};
  Columns q_{}, trial_{}, step_{};
  JointChain::Pose pose_, trial_pose_;
  std::array<double, M> error_{}, trial_error_{};
  std::array<double, 6 * kMaxColumns> jacobian_{};
  double cost_ = 0.0;
};

}  // namespace

PoseSolver::PoseSolver(JointChain chain, const PoseSolverOptions& options)
    : chain_(std::move(chain)), options_(options), length_(std::clamp(0.3 * chain_.reach(), 0.01, 10.0)) {}

PoseSolution PoseSolver::solve(const PoseRequest& request) const {
  if (options_.position_only) return Search<3>(chain_, options_, length_, request).run();
  return Search<6>(chain_, options_, length_, request).run();
}

}  // namespace trundle::planning
