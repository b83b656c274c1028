// Chain of a group's joints to a tip, of a robot's tree of links.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "joint_chain.h"
#include "link_tree.h"

namespace trundle::planning {

struct GroupChain {
  JointChain chain;
  int base = -1;               // link in whose frame the chain's poses are; −1: the model frame
  bool is_base_fixed = false;  // nothing above moves
  Rigid base_pose;             // in the model frame, if it is fixed
};

// The joints from the first one that a column moves to the tip. Floating joints belong to no column.
// `tip_from_link`: pose of the tip in the frame of its link.
GroupChain group_chain(const LinkTree& tree, int link, const Rigid& tip, std::vector<ChainColumn> columns);

}  // namespace trundle::planning
