// Inverse kinematics by damped least squares (Levenberg–Marquardt) within joint limits, with random restarts.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "joint_chain.h"
#include "state_check.h"

namespace trundle::planning {

enum class SolveType { kSpeed, kDistance, kManipulability, kCondition };

struct PoseSolverOptions {
  bool position_only = false;
  double epsilon = 1e-5;  // greatest error of a solution [m], [rad], for each component
  SolveType type = SolveType::kSpeed;
  std::uint64_t seed = 0;
};

struct PoseRequest {
  Rigid target;                        // tip in the model frame
  std::span<const double> state;       // where the search begins; all variables of the model
  std::int64_t iterations = 0;         // budget
  std::span<const double> tolerances;  // per column: greatest distance from the state; empty: any
  StateCheck* check = nullptr;         // must accept a solution
};

struct PoseSolution {
  bool is_found = false;
  std::vector<double> columns;                        // the solution, or the attempt with the smallest error
  double position_error = 0.0, rotation_error = 0.0;  // [m], [rad]
  std::int64_t iterations = 0;                        // spent
  int attempts = 0;
  int refused = 0;  // solutions that the check refused
};

class PoseSolver {
 public:
  PoseSolver(JointChain chain, const PoseSolverOptions& options);

  const JointChain& chain() const { return chain_; }
  PoseSolution solve(const PoseRequest& request) const;

 private:
  JointChain chain_;
  PoseSolverOptions options_;
  double length_;  // [m] that weigh as much as a radian
};

}  // namespace trundle::planning
