// Forward kinematics of a robot's tree of links, as planners need it: rotation matrices, no allocation.
#pragma once

#include <span>
#include <vector>

#include "rigid.h"

namespace trundle::planning {

enum class JointKind { kFixed, kRevolute, kPrismatic, kPlanar, kFloating };

struct TreeJoint {
  JointKind kind = JointKind::kFixed;
  int parent = -1;    // parent link; -1: the model frame. Link i is the child of joint i, and parents come first
  int variable = -1;  // first variable in a state
  Rigid origin;
  Vec3 axis;                            // unit, in the joint frame
  int leader = -1;                      // variable that it follows; -1: none
  double multiplier = 1.0, offset = 0;  // of its leader
};

class LinkTree {
 public:
  LinkTree() = default;
  explicit LinkTree(std::vector<TreeJoint> joints);

  std::size_t size() const { return joints_.size(); }
  const TreeJoint& joint(std::size_t link) const { return joints_[link]; }
  // True if `link` is `ancestor` or below it.
  bool is_below(int link, int ancestor) const;

  // Poses of all links in the model frame. A joint that follows another reads its leader's variable.
  void compute(std::span<const double> state, std::vector<Rigid>& poses) const;

  // Links that move with some variables of a state.
  std::vector<bool> moved_by(std::span<const int> variables) const;

  // Motion of a point of a link with a variable: linear and angular velocity per unit, in the model frame.
  void motion_of(int link, const Vec3& point, int variable, const std::vector<Rigid>& poses, Vec3& linear,
                 Vec3& angular) const;

 private:
  std::vector<TreeJoint> joints_;
};

}  // namespace trundle::planning
