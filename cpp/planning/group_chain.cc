#include "group_chain.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace trundle::planning {

namespace {

// Links from one below the model frame to `link`.
std::vector<int> path_to(const LinkTree& tree, int link) {
  std::vector<int> path;
  for (; link >= 0; link = tree.joint(static_cast<std::size_t>(link)).parent) path.push_back(link);
  std::reverse(path.begin(), path.end());
  return path;
}

// Rotation whose z axis is a unit vector.
Rotation rotation_to(const Vec3& z) {
  const Vec3 other = std::abs(z.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 x = cross(other, z);
  x = (1.0 / norm(x)) * x;
  const Vec3 y = cross(z, x);
  return {{x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z}};
}

class ChainMaker {
 public:
  explicit ChainMaker(std::vector<ChainColumn> columns) : columns_(std::move(columns)) {}

  bool has_column(const TreeJoint& joint) const {
    if (joint.kind == JointKind::kFixed || joint.kind == JointKind::kFloating) return false;
    const int count = joint.kind == JointKind::kPlanar ? 3 : 1;
    const int first = joint.leader < 0 ? joint.variable : joint.leader;
    return std::any_of(columns_.begin(), columns_.end(),
                       [&](const ChainColumn& c) { return c.variable >= first && c.variable < first + count; });
  }

  void add(const TreeJoint& joint) {
    pending_ = pending_ * joint.origin;
    const int variable = joint.leader < 0 ? joint.variable : joint.leader;
    switch (joint.kind) {
      case JointKind::kFixed: break;
      case JointKind::kFloating: throw std::invalid_argument("a floating joint between the group's joints");
      case JointKind::kPlanar:
        add_axis({1, 0, 0}, true, joint.variable, 1.0, 0.0);
        add_axis({0, 1, 0}, true, joint.variable + 1, 1.0, 0.0);
        add_axis({0, 0, 1}, false, joint.variable + 2, 1.0, 0.0);
        break;
      default:
        add_axis(joint.axis, joint.kind == JointKind::kPrismatic, variable, joint.leader < 0 ? 1.0 : joint.multiplier,
                 joint.leader < 0 ? 0.0 : joint.offset);
    }
  }

  JointChain finish(const Rigid& tip) { return {std::move(joints_), pending_ * tip, columns_}; }

 private:
  void add_axis(const Vec3& axis, bool is_prismatic, int variable, double multiplier, double offset) {
    const Rotation aligned = rotation_to(axis);
    const auto found = std::find_if(columns_.begin(), columns_.end(),
                                    [&](const ChainColumn& column) { return column.variable == variable; });
    const int column = found == columns_.end() ? -1 : static_cast<int>(found - columns_.begin());
    joints_.push_back({pending_ * Rigid{aligned, {}}, is_prismatic, column, variable, multiplier, offset});
    pending_ = {transpose(aligned), {}};
  }

  std::vector<ChainColumn> columns_;
  std::vector<ChainJoint> joints_;
  Rigid pending_;  // fixed motion since the last joint
};

}  // namespace

GroupChain group_chain(const LinkTree& tree, int link, const Rigid& tip, std::vector<ChainColumn> columns) {
  ChainMaker maker(std::move(columns));
  int base = -1;
  bool is_moving = false, is_base_fixed = true;
  Rigid base_pose;
  for (const int i : path_to(tree, link)) {
    const TreeJoint& joint = tree.joint(static_cast<std::size_t>(i));
    if (!is_moving && maker.has_column(joint)) {
      is_moving = true;
      base = joint.parent;
    }
    if (is_moving) {
      maker.add(joint);
    } else {
      is_base_fixed &= joint.kind == JointKind::kFixed;
      base_pose = base_pose * joint.origin;
    }
  }
  if (!is_moving) throw std::invalid_argument("no variable of the group moves the tip");
  return {maker.finish(tip), base, is_base_fixed, base_pose};
}

}  // namespace trundle::planning
