#include "link_tree.h"

#include <stdexcept>
#include <utility>

namespace trundle::planning {

namespace {

double position_of(const TreeJoint& joint, std::span<const double> state) {
  if (joint.leader < 0) return state[static_cast<std::size_t>(joint.variable)];
  return joint.multiplier * state[static_cast<std::size_t>(joint.leader)] + joint.offset;
}

Rigid motion_at(const TreeJoint& joint, std::span<const double> state) {
  const double* at = state.data() + joint.variable;
  switch (joint.kind) {
    case JointKind::kRevolute: return {rotation_about(joint.axis, position_of(joint, state)), {}};
    case JointKind::kPrismatic: return {{}, position_of(joint, state) * joint.axis};
    case JointKind::kPlanar: return {rotation_about({0, 0, 1}, at[2]), {at[0], at[1], 0.0}};
    case JointKind::kFloating: return rigid_of(at);
    default: return {};
  }
}

}  // namespace

LinkTree::LinkTree(std::vector<TreeJoint> joints) : joints_(std::move(joints)) {
  for (std::size_t i = 0; i < joints_.size(); ++i)
    if (joints_[i].parent >= static_cast<int>(i)) throw std::invalid_argument("parents come before their children");
}

bool LinkTree::is_below(int link, int ancestor) const {
  for (; link >= 0; link = joints_[static_cast<std::size_t>(link)].parent)
    if (link == ancestor) return true;
  return ancestor < 0;
}

void LinkTree::compute(std::span<const double> state, std::vector<Rigid>& poses) const {
  poses.resize(joints_.size());
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const TreeJoint& joint = joints_[i];
    const Rigid origin = joint.parent < 0 ? joint.origin : poses[static_cast<std::size_t>(joint.parent)] * joint.origin;
    poses[i] = joint.kind == JointKind::kFixed ? origin : origin * motion_at(joint, state);
  }
}

std::vector<bool> LinkTree::moved_by(std::span<const int> variables) const {
  std::vector<bool> moved(joints_.size());
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const TreeJoint& joint = joints_[i];
    moved[i] = joint.parent >= 0 && moved[static_cast<std::size_t>(joint.parent)];
    if (joint.kind == JointKind::kFixed) continue;
    const int count = joint.kind == JointKind::kFloating ? 7 : joint.kind == JointKind::kPlanar ? 3 : 1;
    for (const int variable : variables)
      if (joint.leader >= 0 ? variable == joint.leader
                            : variable >= joint.variable && variable < joint.variable + count)
        moved[i] = true;
  }
  return moved;
}

void LinkTree::motion_of(int link, const Vec3& point, int variable, const std::vector<Rigid>& poses, Vec3& linear,
                         Vec3& angular) const {
  linear = angular = {};
  for (; link >= 0; link = joints_[static_cast<std::size_t>(link)].parent) {
    const TreeJoint& joint = joints_[static_cast<std::size_t>(link)];
    const double factor = joint.leader == variable ? joint.multiplier : joint.variable == variable ? 1.0 : 0.0;
    const Rigid& pose = poses[static_cast<std::size_t>(link)];
    if (joint.kind == JointKind::kRevolute && factor != 0.0 && (joint.leader < 0 || joint.leader == variable)) {
      const Vec3 axis = factor * (pose.r * joint.axis);
      angular = angular + axis;
      linear = linear + cross(axis, point - pose.p);
    } else if (joint.kind == JointKind::kPrismatic && factor != 0.0 && (joint.leader < 0 || joint.leader == variable)) {
      linear = linear + factor * (pose.r * joint.axis);
    } else if (joint.kind == JointKind::kPlanar && variable >= joint.variable && variable < joint.variable + 3) {
      const Rigid base = joint.parent < 0 ? joint.origin : poses[static_cast<std::size_t>(joint.parent)] * joint.origin;
      const int part = variable - joint.variable;
      if (part < 2) {
        linear = linear + base.r.column(part);
      } else {
        angular = angular + base.r.column(2);
        linear = linear + cross(base.r.column(2), point - pose.p);
      }
    } else if (joint.kind == JointKind::kFloating && variable >= joint.variable && variable < joint.variable + 3) {
      const Rigid base = joint.parent < 0 ? joint.origin : poses[static_cast<std::size_t>(joint.parent)] * joint.origin;
      linear = linear + base.r.column(variable - joint.variable);
    }
  }
}

}  // namespace trundle::planning
