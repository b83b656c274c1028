// The joints from a robot's root to a tip, as a solver of inverse kinematics needs them.
#pragma once

#include <span>
#include <vector>

#include "rigid.h"

namespace trundle::planning {

constexpr std::size_t kMaxChainJoints = 64;
constexpr std::size_t kMaxColumns = 32;

// Joint about or along the z axis of its own frame.
struct ChainJoint {
  Rigid before;  // its frame in the frame after the previous joint
  bool is_prismatic = false;
  int column = -1;                        // unknown that moves it; −1: it stays at the state's value
  int variable = 0;                       // in a state
  double multiplier = 1.0, offset = 0.0;  // of the column's value, or of the variable's
};

// Unknown of the equations.
struct ChainColumn {
  int variable = 0;  // in a state
  double lower = 0.0, upper = 0.0;
  bool is_bounded = true;
  bool is_angle = false;  // whole turns change nothing
};

class JointChain {
 public:
  JointChain(std::vector<ChainJoint> joints, const Rigid& tip, std::vector<ChainColumn> columns);

  std::size_t size() const { return columns_.size(); }
  const std::vector<ChainColumn>& columns() const { return columns_; }
  const std::vector<ChainJoint>& joints() const { return joints_; }
  // Greatest distance of the tip from the first joint that moves [m], if no prismatic joint were longer than 1 m.
  double reach() const { return reach_; }

  // Values of joints without a column.
  void hold(std::span<const double> state, std::span<double> held) const;

  struct Pose {
    Rigid tip;
    std::array<Vec3, kMaxChainJoints> axes, origins;
  };
  void place(const double* columns, const double* held, Pose& pose) const;
  // Columns of linear and angular velocity of the tip: (6, size) by rows.
  void jacobian(const Pose& pose, double* rows) const;

 private:
  std::vector<ChainJoint> joints_;
  Rigid tip_;
  std::vector<ChainColumn> columns_;
  double reach_ = 0.0;
};

}  // namespace trundle::planning
