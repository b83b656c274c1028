// The model, states and trajectories of an arm on the parameter server; prints a line for each check that fails.
#include <moveit/kinematic_constraints/utils.h>
#include <moveit/planning_scene/planning_scene.h>
#include <moveit/robot_model_loader/robot_model_loader.h>
#include <moveit/robot_state/conversions.h>
#include <moveit/robot_state/robot_state.h>
#include <moveit/trajectory_processing/iterative_time_parameterization.h>
#include <ros/ros.h>

#include <cmath>
#include <iostream>
#include <sstream>

namespace {

int made = 0, failed = 0;
#define CHECK(cond)                                                        \
  do {                                                                     \
    ++made;                                                                \
    if (!(cond)) {                                                         \
      ++failed;                                                            \
      std::cout << "failed, line " << __LINE__ << ": " #cond << std::endl; \
    }                                                                      \
  } while (false)

bool isNear(double one, double other, double tolerance = 1e-9) { return std::fabs(one - other) < tolerance; }

void checkModel(const robot_model::RobotModel& model) {
  CHECK(model.getName() == "elbow" && model.getModelFrame() == "base" && model.getRootLinkName() == "base");
  CHECK(model.getRootJointName() == "fixed_base" && model.getVariableCount() == 8);
  CHECK(model.getJointModelGroupNames() == std::vector<std::string>({"arm", "hand", "whole"}));
  const robot_model::JointModelGroup& arm = *model.getJointModelGroup("arm");
  CHECK(arm.isChain() && arm.getVariableCount() == 6 && arm.getActiveJointModelNames().front() == "j1");
  CHECK(arm.getOnlyOneEndEffectorTip()->getName() == "l6" && arm.getDefaultStateNames().front() == "ready");
  CHECK(arm.getAttachedEndEffectorNames() == std::vector<std::string>({"gripper"}));
  CHECK(model.getEndEffector("gripper")->getEndEffectorParentGroup() == std::make_pair(std::string("arm"), std::string("l6")));
  const robot_model::JointModelGroup& hand = *model.getJointModelGroup("hand");
  CHECK(hand.getActiveJointModelNames() == std::vector<std::string>({"finger"}) && hand.getMimicJointModels().size() == 1);
  CHECK(model.getJointModelGroup("whole")->getActiveJointModels().size() == 7);
  const robot_model::VariableBounds& bounds = model.getVariableBounds("j1");
  CHECK(bounds.max_velocity_ == 1.5 && bounds.acceleration_bounded_ && bounds.max_acceleration_ == 3.0);  // joint_limits
  CHECK(model.getVariableBounds("j2").max_velocity_ == 2.0);                                              // URDF
  CHECK(model.getJointModelGroup("none") == nullptr && model.getLinkModel("none") == nullptr);
}

void checkState(const robot_model::RobotModelPtr& model) {
  const robot_model::JointModelGroup* arm = model->getJointModelGroup("arm");
  robot_state::RobotState state(model);
  CHECK(state.setToDefaultValues(arm, "ready") && isNear(state.getVariablePosition("j2"), 0.5));
  CHECK(!state.setToDefaultValues(arm, "none"));
  state.setVariablePosition("finger", 0.02);
  CHECK(isNear(state.getVariablePosition("thumb"), 0.02));  // mimic
  state.setToDefaultValues();
  // Straight up: 0.3 to the shoulder, 0.4 + 0.3 of upper arm and forearm, 0.1 of the hand.
  CHECK(state.getGlobalLinkTransform("l6").translation().isApprox(Eigen::Vector3d(0, 0, 1.1), 1e-9));
  state.setVariablePosition("j2", M_PI / 2);
  CHECK(state.getGlobalLinkTransform("l6").translation().isApprox(Eigen::Vector3d(0.8, 0, 0.3), 1e-9));
  CHECK(state.getFrameTransform("base").isApprox(Eigen::Isometry3d::Identity()));

  sensor_msgs::JointState values;
  values.name = {"j2", "j1"};
  values.position = {0.4, 0.1};
  values.velocity = {0.2, 0.3};
  state.setVariableValues(values);
  CHECK(isNear(state.getVariablePosition("j2"), 0.4) && isNear(state.getVariableVelocity("j1"), 0.3) && !state.hasEffort());
  state.dropVelocities();

  state.setToRandomPositions(arm);
  CHECK(state.satisfiesBounds(arm));
  const Eigen::MatrixXd jacobian = state.getJacobian(arm);
  const double h = 1e-7;
  for (int i = 0; i < 6; ++i) {
    robot_state::RobotState moved = state;
    const std::string name = "j" + std::to_string(i + 1);
    moved.setVariablePosition(name, state.getVariablePosition(name) + h);
    const Eigen::Isometry3d &from = state.getGlobalLinkTransform("l6"), &to = moved.getGlobalLinkTransform("l6");
    const Eigen::AngleAxisd turn(to.linear() * from.linear().transpose());
    CHECK(((to.translation() - from.translation()) / h - jacobian.col(i).head<3>()).norm() < 1e-5);
    CHECK((turn.angle() * turn.axis() / h - jacobian.col(i).tail<3>()).norm() < 1e-5);
  }

  int solved = 0;
  for (int i = 0; i < 100; ++i) {
    state.setToRandomPositions(arm);
    const Eigen::Isometry3d pose = state.getGlobalLinkTransform("l6");
    robot_state::RobotState answer(model);
    if (!answer.setFromIK(arm, pose, 0.1)) continue;
    ++solved;
    CHECK(answer.satisfiesBounds(arm));
    CHECK((answer.getGlobalLinkTransform("l6").translation() - pose.translation()).norm() < 2e-5);
    CHECK(Eigen::AngleAxisd(answer.getGlobalLinkTransform("l6").linear().transpose() * pose.linear()).angle() < 2e-4);
  }
  CHECK(solved >= 99);
  geometry_msgs::Pose far;
  far.position.x = 5.0;
  far.orientation.w = 1.0;
  const double before = state.getVariablePosition("j1");
  CHECK(!state.setFromIK(arm, far, 0.01) && state.getVariablePosition("j1") == before);

  state.setVariablePosition("j2", 9.0);
  CHECK(!state.satisfiesBounds(arm));
  state.enforceBounds();
  CHECK(state.satisfiesBounds(arm) && isNear(state.getVariablePosition("j2"), 2.0));

  moveit_msgs::RobotState message;
  robot_state::robotStateToRobotStateMsg(state, message);
  robot_state::RobotState copy(model);
  CHECK(robot_state::robotStateMsgToRobotState(message, copy) && isNear(copy.distance(state), 0.0));
  message.joint_state.position.pop_back();
  CHECK(!robot_state::robotStateMsgToRobotState(message, copy));
  CHECK(!robot_state::robotStateMsgToRobotState(moveit_msgs::RobotState(), copy));
}

void checkTrajectory(const robot_model::RobotModelPtr& model) {
  const robot_model::JointModelGroup* arm = model->getJointModelGroup("arm");
  robot_trajectory::RobotTrajectory trajectory(model, "arm");
  robot_state::RobotState state(model);
  for (int i = 0; i < 20; ++i) {
    state.setVariablePosition("j1", 1.5 * std::sin(0.3 * i));
    state.setVariablePosition("j4", 0.1 * i);
    trajectory.addSuffixWayPoint(state, 0.0);
  }
  CHECK(trajectory_processing::IterativeParabolicTimeParameterization().computeTimeStamps(trajectory));
  moveit_msgs::RobotTrajectory message;
  trajectory.getRobotTrajectoryMsg(message);
  CHECK(message.joint_trajectory.points.size() == 20 && message.joint_trajectory.joint_names.size() == 6);
  double before = -1.0;
  for (const auto& point : message.joint_trajectory.points) {
    CHECK(point.time_from_start.toSec() > before);
    before = point.time_from_start.toSec();
    for (std::size_t i = 0; i < 6; ++i) {
      const auto& bounds = model->getVariableBounds(message.joint_trajectory.joint_names[i]);
      CHECK(std::fabs(point.velocities[i]) <= bounds.max_velocity_ + 1e-9);
      CHECK(std::fabs(point.accelerations[i]) <= (bounds.acceleration_bounded_ ? bounds.max_acceleration_ : 1.0) + 1e-9);
    }
  }
  robot_trajectory::RobotTrajectory copy(model, "arm");
  copy.setRobotTrajectoryMsg(state, message);
  CHECK(isNear(copy.getDuration(), trajectory.getDuration(), 1e-6) && copy.size() == 20);
  copy.reverse();
  CHECK(isNear(copy.getFirstWayPoint().getVariablePosition("j4"), 1.9));

  state.setToDefaultValues(arm, "ready");
  std::vector<robot_state::RobotStatePtr> path;
  Eigen::Isometry3d target = state.getGlobalLinkTransform("l6");
  target.translation().z() -= 0.1;
  const double fraction = state.computeCartesianPath(arm, path, state.getLinkModel("l6"), target, true,
                                                     moveit::core::MaxEEFStep(0.01), moveit::core::JumpThreshold());
  CHECK(isNear(fraction, 1.0) && path.size() == 11);
  CHECK(isNear(path[5]->getGlobalLinkTransform("l6").translation().z(), target.translation().z() + 0.05, 1e-4));

  const moveit_msgs::Constraints goal = kinematic_constraints::constructGoalConstraints(state, arm, 0.01);
  moveit_msgs::Constraints narrow = goal;
  narrow.joint_constraints.resize(1);
  narrow.joint_constraints[0].position += 0.015;
  const moveit_msgs::Constraints merged = kinematic_constraints::mergeConstraints(goal, narrow);
  CHECK(merged.joint_constraints.size() == 6);
  CHECK(isNear(merged.joint_constraints[0].tolerance_below + merged.joint_constraints[0].tolerance_above, 0.005));
  CHECK(kinematic_constraints::isEmpty(moveit_msgs::Constraints()) && !kinematic_constraints::isEmpty(goal));
}

void checkScene(const robot_model::RobotModelPtr& model) {
  planning_scene::PlanningScene scene(model);
  collision_detection::AllowedCollision::Type type;
  CHECK(scene.getAllowedCollisionMatrix().getEntry("base", "l1", type) && type == collision_detection::AllowedCollision::ALWAYS);
  CHECK(scene.getAllowedCollisionMatrix().getEntry("base", "l3", type) && type == collision_detection::AllowedCollision::NEVER);
  std::string fault;
  try {
    scene.isStateColliding();
  } catch (const moveit::Exception& error) {
    fault = error.what();
  }
  CHECK(fault.find("start move_group first") != std::string::npos);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "arm");
  ros::NodeHandle node;
  robot_model_loader::RobotModelLoader loader("robot_description");
  const robot_model::RobotModelPtr model = loader.getModel();
  if (!model) {
    std::cout << "no model" << std::endl;
    return 1;
  }
  checkModel(*model);
  checkState(model);
  checkTrajectory(model);
  checkScene(model);
  std::cout << made << " checks, " << failed << " failed" << std::endl;
  return failed == 0 ? 0 : 1;
}
