#include "joint_chain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace trundle::planning {

JointChain::JointChain(std::vector<ChainJoint> joints, const Rigid& tip, std::vector<ChainColumn> columns)
    : joints_(std::move(joints)), tip_(tip), columns_(std::move(columns)) {
  if (joints_.size() > kMaxChainJoints) throw std::invalid_argument("more than 64 joints between the root and the tip");
  if (columns_.size() > kMaxColumns) throw std::invalid_argument("more than 32 variables between the root and the tip");
  bool is_moving = false;
  for (const ChainJoint& joint : joints_) {
    if (joint.column >= static_cast<int>(columns_.size())) throw std::invalid_argument("no such column");
    if (is_moving) reach_ += norm(joint.before.p);
    is_moving |= joint.column >= 0;
    if (joint.column < 0 || !joint.is_prismatic) continue;
    const ChainColumn& column = columns_[static_cast<std::size_t>(joint.column)];
    const double travel = std::max(std::abs(column.lower), std::abs(column.upper)) * std::abs(joint.multiplier);
    reach_ += column.is_bounded ? std::min(travel, 1.0) : 1.0;
  }
  reach_ += norm(tip_.p);
}

void JointChain::hold(std::span<const double> state, std::span<double> held) const {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const ChainJoint& joint = joints_[i];
    if (joint.column < 0) held[i] = joint.multiplier * state[static_cast<std::size_t>(joint.variable)] + joint.offset;
  }
}

void JointChain::place(const double* columns, const double* held, Pose& pose) const {
  Rotation r;
  Vec3 p;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const ChainJoint& joint = joints_[i];
    p = r * joint.before.p + p;
    r = r * joint.before.r;
    const double value = joint.column < 0 ? held[i] : joint.multiplier * columns[joint.column] + joint.offset;
    const Vec3 axis = r.column(2);
    if (joint.is_prismatic) {
      p = p + value * axis;
    } else {
      const double s = std::sin(value), c = std::cos(value);
      for (std::size_t row = 0; row < 9; row += 3) {
        const double x = r.m[row], y = r.m[row + 1];
        r.m[row] = c * x + s * y;
        r.m[row + 1] = c * y - s * x;
      }
    }
    pose.axes[i] = axis;
    pose.origins[i] = p;
  }
  pose.tip = {r * tip_.r, r * tip_.p + p};
}

void JointChain::jacobian(const Pose& pose, double* rows) const {
  const std::size_t n = columns_.size();
  std::fill(rows, rows + 6 * n, 0.0);
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const ChainJoint& joint = joints_[i];
    if (joint.column < 0) continue;
    double* at = rows + joint.column;
    const Vec3 axis = joint.multiplier * pose.axes[i];
    const Vec3 linear = joint.is_prismatic ? axis : cross(axis, pose.tip.p - pose.origins[i]);
    at[0] += linear.x;
    at[n] += linear.y;
    at[2 * n] += linear.z;
    if (joint.is_prismatic) continue;
    at[3 * n] += axis.x;
    at[4 * n] += axis.y;
    at[5 * n] += axis.z;
  }
}

}  // namespace trundle::planning
