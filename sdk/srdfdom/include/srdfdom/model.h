#pragma once

#include <urdf_model/model.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace srdf {

/** What a semantic description (SRDF) says about a robot; names that the robot lacks are left out with a warning. */
class Model {
 public:
  struct Group {
    std::string name_;
    std::vector<std::string> joints_, links_;
    /** Base link and tip link of each chain. */
    std::vector<std::pair<std::string, std::string>> chains_;
    std::vector<std::string> subgroups_;
  };
  /** Joint between the robot's root and the outside; `type_` is fixed, planar or floating. */
  struct VirtualJoint {
    std::string name_, type_, parent_frame_, child_link_;
  };
  struct EndEffector {
    std::string name_, parent_link_, parent_group_, component_group_;
  };
  struct GroupState {
    std::string name_, group_;
    std::map<std::string, std::vector<double>> joint_values_;
  };
  struct PassiveJoint {
    std::string name_;
  };
  struct DisabledCollision {
    std::string link1_, link2_, reason_;
  };
  typedef DisabledCollision CollisionPair;

  bool initString(const urdf::ModelInterface& urdf_model, const std::string& xmlstring);
  bool initFile(const urdf::ModelInterface& urdf_model, const std::string& filename);
  void clear() { *this = Model(); }

  const std::string& getName() const { return name_; }
  const std::vector<VirtualJoint>& getVirtualJoints() const { return virtual_joints_; }
  const std::vector<Group>& getGroups() const { return groups_; }
  const std::vector<EndEffector>& getEndEffectors() const { return end_effectors_; }
  const std::vector<GroupState>& getGroupStates() const { return group_states_; }
  const std::vector<PassiveJoint>& getPassiveJoints() const { return passive_joints_; }
  const std::vector<DisabledCollision>& getDisabledCollisionPairs() const { return disabled_collisions_; }

 private:
  std::string name_;
  std::vector<VirtualJoint> virtual_joints_;
  std::vector<Group> groups_;
  std::vector<EndEffector> end_effectors_;
  std::vector<GroupState> group_states_;
  std::vector<PassiveJoint> passive_joints_;
  std::vector<DisabledCollision> disabled_collisions_;
};
typedef std::shared_ptr<Model> ModelSharedPtr;
typedef std::shared_ptr<const Model> ModelConstSharedPtr;

}  // namespace srdf
