// A tree of links as Python holds it.
#pragma once

#include <algorithm>
#include <utility>

#include "link_tree.h"

namespace trundle::planning {

class TreeKinematics {
 public:
  explicit TreeKinematics(LinkTree tree) : tree_(std::move(tree)) {
    for (std::size_t i = 0; i < tree_.size(); ++i) {
      const TreeJoint& joint = tree_.joint(i);
      const int size = joint.kind == JointKind::kFixed      ? 0
                       : joint.kind == JointKind::kPlanar   ? 3
                       : joint.kind == JointKind::kFloating ? 7
                                                            : 1;
      if (size > 0) variables_ = std::max(variables_, static_cast<std::size_t>(joint.variable + size));
    }
  }

  const LinkTree& tree() const { return tree_; }
  std::size_t variables() const { return variables_; }  // in a state

 private:
  LinkTree tree_;
  std::size_t variables_ = 0;
};

}  // namespace trundle::planning
