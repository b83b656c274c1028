#pragma once

#include <geometry_msgs/Pose.h>
#include <moveit_msgs/AttachedCollisionObject.h>
#include <moveit_msgs/RobotState.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include <boost/function.hpp>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "moveit/robot_model/robot_model.h"

namespace moveit {
namespace core {

MOVEIT_CLASS_FORWARD(RobotState)

/** Whether a solution of the group's joints may be used; may change the state. */
typedef boost::function<bool(RobotState* state, const JointModelGroup* group, const double* joint_group_values)>
    GroupStateValidityCallbackFn;

/** Largest jump between neighbouring steps of a Cartesian path: as a factor of the mean step, or absolute [rad], [m];
 * 0 means that it is not checked. */
struct JumpThreshold {
  double factor, revolute, prismatic;
  JumpThreshold() : JumpThreshold(0.0) {}
  explicit JumpThreshold(double jt_factor) : factor(jt_factor), revolute(0.0), prismatic(0.0) {}
  JumpThreshold(double jt_revolute, double jt_prismatic)
      : factor(0.0), revolute(jt_revolute), prismatic(jt_prismatic) {}
};
/** Longest step of a Cartesian path: [m] and [rad]. */
struct MaxEEFStep {
  double translation, rotation;
  MaxEEFStep(double translation = 0.0, double rotation = 0.0) : translation(translation), rotation(rotation) {}
};

/**
 * Positions, velocities, accelerations and efforts of a robot's variables, and the poses of its links in the model's
 * frame, which are computed when they are asked for.
 *
 * setFromIK solves with damped least squares from this state and, if that fails, from random ones; it needs no plugin.
 */
class RobotState {
 public:
  explicit RobotState(const RobotModelConstPtr& robot_model);

  const RobotModelConstPtr& getRobotModel() const { return model_; }
  std::size_t getVariableCount() const { return position_.size(); }
  const std::vector<std::string>& getVariableNames() const { return model_->getVariableNames(); }
  const LinkModel* getLinkModel(const std::string& link) const { return model_->getLinkModel(link); }
  const JointModel* getJointModel(const std::string& joint) const { return model_->getJointModel(joint); }
  const JointModelGroup* getJointModelGroup(const std::string& group) const {
    return model_->getJointModelGroup(group);
  }

  double* getVariablePositions() {
    is_stale_ = true;
    return position_.data();
  }
  const double* getVariablePositions() const { return position_.data(); }
  double getVariablePosition(const std::string& variable) const { return position_[index(variable)]; }
  double getVariablePosition(int index) const { return position_[static_cast<std::size_t>(index)]; }
  void setVariablePositions(const double* position);
  void setVariablePositions(const std::vector<double>& position);
  void setVariablePositions(const std::map<std::string, double>& variables);
  void setVariablePositions(const std::vector<std::string>& names, const std::vector<double>& positions);
  /** Set the positions, and the velocities and efforts if there are any, of the variables that a message names. */
  void setVariableValues(const sensor_msgs::JointState& values);
  void setVariablePosition(const std::string& variable, double value) { setPosition(index(variable), value); }
  void setVariablePosition(int index, double value) { setPosition(static_cast<std::size_t>(index), value); }

  bool hasVelocities() const { return has_velocity_; }
  double* getVariableVelocities() {
    has_velocity_ = true;
    return velocity_.data();
  }
  const double* getVariableVelocities() const { return velocity_.data(); }
  double getVariableVelocity(const std::string& variable) const { return velocity_[index(variable)]; }
  void setVariableVelocity(const std::string& variable, double value) {
    getVariableVelocities()[index(variable)] = value;
  }
  void setVariableVelocities(const std::vector<double>& velocity);
  void zeroVelocities() { velocity_.assign(velocity_.size(), 0.0); }
  void dropVelocities() { has_velocity_ = false; }
  bool hasAccelerations() const { return has_acceleration_; }
  double* getVariableAccelerations() {
    has_acceleration_ = true;
    return acceleration_.data();
  }
  const double* getVariableAccelerations() const { return acceleration_.data(); }
  double getVariableAcceleration(const std::string& variable) const { return acceleration_[index(variable)]; }
  bool hasEffort() const { return has_effort_; }
  const double* getVariableEffort() const { return effort_.data(); }
  double getVariableEffort(const std::string& variable) const { return effort_[index(variable)]; }
  void setVariableEffort(const std::string& variable, double value) {
    has_effort_ = true;
    effort_[index(variable)] = value;
  }

  void setJointPositions(const std::string& joint, const double* position) {
    setJointPositions(getJointModel(joint), position);
  }
  void setJointPositions(const std::string& joint, const std::vector<double>& position) {
    setJointPositions(joint, position.data());
  }
  void setJointPositions(const JointModel* joint, const double* position);
  const double* getJointPositions(const std::string& joint) const { return getJointPositions(getJointModel(joint)); }
  const double* getJointPositions(const JointModel* joint) const {
    return position_.data() + joint->getFirstVariableIndex();
  }

  /** Values are in the order of the group's variables. */
  void setJointGroupPositions(const std::string& group, const double* values) {
    setJointGroupPositions(getJointModelGroup(group), values);
  }
  void setJointGroupPositions(const std::string& group, const std::vector<double>& values) {
    setJointGroupPositions(group, values.data());
  }
  void setJointGroupPositions(const std::string& group, const Eigen::VectorXd& values) {
    setJointGroupPositions(group, values.data());
  }
  void setJointGroupPositions(const JointModelGroup* group, const std::vector<double>& values) {
    setJointGroupPositions(group, values.data());
  }
  void setJointGroupPositions(const JointModelGroup* group, const Eigen::VectorXd& values) {
    setJointGroupPositions(group, values.data());
  }
  void setJointGroupPositions(const JointModelGroup* group, const double* values);
  /** Values are in the order of the group's active joints. */
  void setJointGroupActivePositions(const JointModelGroup* group, const std::vector<double>& values);
  void setJointGroupActivePositions(const std::string& group, const std::vector<double>& values) {
    setJointGroupActivePositions(getJointModelGroup(group), values);
  }
  void copyJointGroupPositions(const std::string& group, std::vector<double>& values) const {
    copyJointGroupPositions(getJointModelGroup(group), values);
  }
  void copyJointGroupPositions(const std::string& group, double* values) const {
    copyJointGroupPositions(getJointModelGroup(group), values);
  }
  void copyJointGroupPositions(const std::string& group, Eigen::VectorXd& values) const {
    copyJointGroupPositions(getJointModelGroup(group), values);
  }
  void copyJointGroupPositions(const JointModelGroup* group, std::vector<double>& values) const;
  void copyJointGroupPositions(const JointModelGroup* group, double* values) const;
  void copyJointGroupPositions(const JointModelGroup* group, Eigen::VectorXd& values) const;
  void copyJointGroupVelocities(const JointModelGroup* group, std::vector<double>& values) const;

  void setToDefaultValues();
  /** Set the group to a state of the SRDF; false if there is none of that name. */
  bool setToDefaultValues(const JointModelGroup* group, const std::string& name);
  bool setToDefaultValues(const std::string& group, const std::string& name);
  void setToRandomPositions();
  void setToRandomPositions(const JointModelGroup* group);
  void setToRandomPositions(const JointModelGroup* group, std::mt19937& random);
  /** Random positions within a distance [m or rad] of those of another state. */
  void setToRandomPositionsNearBy(const JointModelGroup* group, const RobotState& seed, double distance);

  void update(bool force = false);
  void updateLinkTransforms() { update(); }
  bool dirty() const { return is_stale_; }
  const Eigen::Isometry3d& getGlobalLinkTransform(const std::string& link) const;
  const Eigen::Isometry3d& getGlobalLinkTransform(const LinkModel* link) const;
  /** Pose of a link, or of the model's frame; raises moveit::Exception for an unknown frame. */
  const Eigen::Isometry3d& getFrameTransform(const std::string& frame) const;
  bool knowsFrameTransform(const std::string& frame) const;

  /** 6 × n (n: variables of the group): velocity and angular velocity, in the frame of the group's first joint's parent
   * link, of a point of a link [m, in the link's frame]. */
  bool getJacobian(const JointModelGroup* group, const LinkModel* link, const Eigen::Vector3d& reference_point_position,
                   Eigen::MatrixXd& jacobian, bool use_quaternion_representation = false) const;
  Eigen::MatrixXd getJacobian(const JointModelGroup* group,
                              const Eigen::Vector3d& reference_point_position = Eigen::Vector3d::Zero()) const;

  /** Move the group so that its tip has a pose in the model's frame. The timeout [s] is counted in attempts, one
   * for each half of a millisecond and at least ten, so that the same call gives the same answer. */
  bool setFromIK(const JointModelGroup* group, const geometry_msgs::Pose& pose, double timeout = 0.0,
                 const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn());
  bool setFromIK(const JointModelGroup* group, const geometry_msgs::Pose& pose, const std::string& tip,
                 double timeout = 0.0, const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn());
  bool setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose, double timeout = 0.0,
                 const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn());
  bool setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose, const std::string& tip,
                 double timeout = 0.0, const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn());
  /** The number of attempts is that of releases before Melodic; it only multiplies the timeout. */
  bool setFromIK(const JointModelGroup* group, const geometry_msgs::Pose& pose, unsigned int attempts, double timeout,
                 const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn()) {
    return setFromIK(group, pose, attempts * timeout, constraint);
  }
  bool setFromIK(const JointModelGroup* group, const Eigen::Isometry3d& pose, unsigned int attempts, double timeout,
                 const GroupStateValidityCallbackFn& constraint = GroupStateValidityCallbackFn()) {
    return setFromIK(group, pose, attempts * timeout, constraint);
  }

  /** Move the tip along a direction [m] or through poses; returns the distance, or the fraction from 0 to 1. */
  double computeCartesianPath(const JointModelGroup* group, std::vector<RobotStatePtr>& trajectory,
                              const LinkModel* link, const Eigen::Isometry3d& target, bool global_reference_frame,
                              const MaxEEFStep& max_step, const JumpThreshold& jump_threshold,
                              const GroupStateValidityCallbackFn& valid = GroupStateValidityCallbackFn());
  double computeCartesianPath(const JointModelGroup* group, std::vector<RobotStatePtr>& trajectory,
                              const LinkModel* link, const std::vector<Eigen::Isometry3d>& waypoints,
                              bool global_reference_frame, const MaxEEFStep& max_step,
                              const JumpThreshold& jump_threshold,
                              const GroupStateValidityCallbackFn& valid = GroupStateValidityCallbackFn());

  bool satisfiesBounds(double margin = 0.0) const;
  bool satisfiesBounds(const JointModelGroup* group, double margin = 0.0) const;
  bool satisfiesBounds(const JointModel* joint, double margin = 0.0) const {
    return joint->satisfiesPositionBounds(getJointPositions(joint), margin);
  }
  void enforceBounds();
  void enforceBounds(const JointModelGroup* group);
  double distance(const RobotState& other) const;
  double distance(const RobotState& other, const JointModelGroup* group) const;
  void interpolate(const RobotState& to, double t, RobotState& state) const;
  void interpolate(const RobotState& to, double t, RobotState& state, const JointModelGroup* group) const;

  const std::vector<moveit_msgs::AttachedCollisionObject>& attachedBodies() const { return attached_; }
  bool hasAttachedBody(const std::string& id) const;
  void attachBody(const moveit_msgs::AttachedCollisionObject& body);
  bool clearAttachedBody(const std::string& id);
  void clearAttachedBodies() { attached_.clear(); }

  void printStatePositions(std::ostream& out = std::cout) const;
  void printStateInfo(std::ostream& out = std::cout) const { printStatePositions(out); }

 private:
  std::size_t index(const std::string& variable) const { return model_->getVariableIndex(variable); }
  void setPosition(std::size_t index, double value);
  void updateMimicJoints();
  void computeTransforms() const;
  void setRandom(const JointModel& joint, std::mt19937& random);
  bool approach(const JointModelGroup& group, const LinkModel& tip, const Eigen::Isometry3d& pose);

  RobotModelConstPtr model_;
  std::vector<double> position_, velocity_, acceleration_, effort_;
  bool has_velocity_ = false, has_acceleration_ = false, has_effort_ = false;
  mutable bool is_stale_ = true;
  mutable std::vector<Eigen::Isometry3d, Eigen::aligned_allocator<Eigen::Isometry3d>> transforms_;
  std::vector<moveit_msgs::AttachedCollisionObject> attached_;
};

std::ostream& operator<<(std::ostream& out, const RobotState& state);

}  // namespace core
}  // namespace moveit

namespace robot_state = moveit::core;
