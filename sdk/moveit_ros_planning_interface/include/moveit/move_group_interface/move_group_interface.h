#pragma once

#include <actionlib/client/simple_action_client.h>
#include <geometry_msgs/PoseStamped.h>
#include <moveit_msgs/Constraints.h>
#include <moveit_msgs/Grasp.h>
#include <moveit_msgs/MoveGroupAction.h>
#include <moveit_msgs/PlaceLocation.h>
#include <moveit_msgs/PlannerInterfaceDescription.h>
#include <moveit_msgs/RobotTrajectory.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <tf2_ros/buffer.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "moveit/macros/class_forward.h"
#include "moveit/robot_state/robot_state.h"
#include "moveit/utils/moveit_error_code.h"

namespace moveit {
namespace planning_interface {

using moveit::core::MoveItErrorCode;

MOVEIT_CLASS_FORWARD(MoveGroupInterface)

/** One group of a robot, moved by the move_group that runs. Lengths are in m, angles in rad, times in s. */
class MoveGroupInterface {
 public:
  static const std::string ROBOT_DESCRIPTION;

  struct Options {
    explicit Options(const std::string& group_name, const std::string& desc = ROBOT_DESCRIPTION,
                     const ros::NodeHandle& node_handle = ros::NodeHandle())
        : group_name_(group_name), robot_description_(desc), node_handle_(node_handle) {}

    std::string group_name_, robot_description_;
    /** Loaded from the parameters if it is null. */
    moveit::core::RobotModelConstPtr robot_model_;
    ros::NodeHandle node_handle_;
  };
  MOVEIT_STRUCT_FORWARD(Plan)
  struct Plan {
    moveit_msgs::RobotState start_state_;
    moveit_msgs::RobotTrajectory trajectory_;
    double planning_time_ = 0.0;
  };

  /** Raises std::runtime_error for a robot or a group that does not exist; waits for move_group, without end if the
   * time is 0 s. */
  MoveGroupInterface(const Options& options, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer = {},
                     const ros::WallDuration& wait_for_servers = ros::WallDuration());
  MoveGroupInterface(const std::string& group, const std::shared_ptr<tf2_ros::Buffer>& tf_buffer = {},
                     const ros::WallDuration& wait_for_servers = ros::WallDuration())
      : MoveGroupInterface(Options(group), tf_buffer, wait_for_servers) {}
  ~MoveGroupInterface();
  MoveGroupInterface(const MoveGroupInterface&) = delete;
  MoveGroupInterface& operator=(const MoveGroupInterface&) = delete;
  MoveGroupInterface(MoveGroupInterface&& other) noexcept;
  MoveGroupInterface& operator=(MoveGroupInterface&& other) noexcept;

  const std::string& getName() const;
  std::vector<std::string> getNamedTargets() const;
  moveit::core::RobotModelConstPtr getRobotModel() const;
  const ros::NodeHandle& getNodeHandle() const;
  const std::string& getPlanningFrame() const;
  const std::vector<std::string>& getJointModelGroupNames() const;
  const std::vector<std::string>& getJointNames() const;
  const std::vector<std::string>& getLinkNames() const;
  std::map<std::string, double> getNamedTargetValues(const std::string& name) const;
  const std::vector<std::string>& getActiveJoints() const;
  const std::vector<std::string>& getJoints() const;
  unsigned int getVariableCount() const;

  bool getInterfaceDescription(moveit_msgs::PlannerInterfaceDescription& description) const;
  std::map<std::string, std::string> getPlannerParams(const std::string& planner_id,
                                                      const std::string& group = "") const;
  void setPlannerParams(const std::string& planner_id, const std::string& group,
                        const std::map<std::string, std::string>& params, bool replace = false);
  std::string getDefaultPlannerId(const std::string& group = "") const;
  void setPlannerId(const std::string& planner_id);
  const std::string& getPlannerId() const;
  void setPlanningPipelineId(const std::string& pipeline_id);
  const std::string& getPlanningPipelineId() const;
  void setPlanningTime(double seconds);
  double getPlanningTime() const;
  void setNumPlanningAttempts(unsigned int attempts);
  /** Fractions of the limits, from 0 to 1. */
  void setMaxVelocityScalingFactor(double factor);
  void setMaxAccelerationScalingFactor(double factor);

  void setGoalTolerance(double tolerance);
  void setGoalJointTolerance(double tolerance);
  void setGoalPositionTolerance(double tolerance);
  void setGoalOrientationTolerance(double tolerance);
  double getGoalJointTolerance() const;
  double getGoalPositionTolerance() const;
  double getGoalOrientationTolerance() const;
  void setWorkspace(double minx, double miny, double minz, double maxx, double maxy, double maxz);
  void setStartState(const moveit_msgs::RobotState& start_state);
  void setStartState(const moveit::core::RobotState& start_state);
  void setStartStateToCurrentState();
  void setSupportSurfaceName(const std::string& name);

  /** Set positions to move to; false if one is out of its limits or unknown. */
  bool setJointValueTarget(const std::vector<double>& group_variable_values);
  bool setJointValueTarget(const std::map<std::string, double>& variable_values);
  bool setJointValueTarget(const std::vector<std::string>& variable_names, const std::vector<double>& variable_values);
  bool setJointValueTarget(const moveit::core::RobotState& state);
  bool setJointValueTarget(const std::string& joint_name, const std::vector<double>& values);
  bool setJointValueTarget(const std::string& joint_name, double value);
  bool setJointValueTarget(const sensor_msgs::JointState& state);
  /** Set the positions that inverse kinematics give for a pose of the end effector. */
  bool setJointValueTarget(const geometry_msgs::Pose& eef_pose, const std::string& end_effector_link = "");
  bool setJointValueTarget(const geometry_msgs::PoseStamped& eef_pose, const std::string& end_effector_link = "");
  bool setJointValueTarget(const Eigen::Isometry3d& eef_pose, const std::string& end_effector_link = "");
  void getJointValueTarget(std::vector<double>& group_variable_values) const;
  const moveit::core::RobotState& getJointValueTarget() const;
  const moveit::core::RobotState& getTargetRobotState() const { return getJointValueTarget(); }
  void setRandomTarget();
  bool setNamedTarget(const std::string& name);

  bool setPositionTarget(double x, double y, double z, const std::string& end_effector_link = "");
  bool setRPYTarget(double roll, double pitch, double yaw, const std::string& end_effector_link = "");
  bool setOrientationTarget(double x, double y, double z, double w, const std::string& end_effector_link = "");
  bool setPoseTarget(const Eigen::Isometry3d& end_effector_pose, const std::string& end_effector_link = "");
  bool setPoseTarget(const geometry_msgs::Pose& target, const std::string& end_effector_link = "");
  bool setPoseTarget(const geometry_msgs::PoseStamped& target, const std::string& end_effector_link = "");
  /** Poses of which one is to be reached. */
  bool setPoseTargets(const std::vector<geometry_msgs::Pose>& target, const std::string& end_effector_link = "");
  bool setPoseTargets(const std::vector<geometry_msgs::PoseStamped>& target, const std::string& end_effector_link = "");
  void setPoseReferenceFrame(const std::string& pose_reference_frame);
  const std::string& getPoseReferenceFrame() const;
  bool setEndEffectorLink(const std::string& end_effector_link);
  bool setEndEffector(const std::string& eef_name);
  const std::string& getEndEffectorLink() const;
  const std::string& getEndEffector() const;
  void clearPoseTarget(const std::string& end_effector_link = "");
  void clearPoseTargets();
  const geometry_msgs::PoseStamped& getPoseTarget(const std::string& end_effector_link = "") const;
  const std::vector<geometry_msgs::PoseStamped>& getPoseTargets(const std::string& end_effector_link = "") const;

  void allowLooking(bool flag);
  void allowReplanning(bool flag);
  void setReplanAttempts(int attempts);
  void setReplanDelay(double seconds);
  MoveItErrorCode asyncMove();
  actionlib::SimpleActionClient<moveit_msgs::MoveGroupAction>& getMoveGroupClient() const;
  MoveItErrorCode move();
  MoveItErrorCode plan(Plan& plan);
  MoveItErrorCode asyncExecute(const Plan& plan) { return asyncExecute(plan.trajectory_); }
  MoveItErrorCode asyncExecute(const moveit_msgs::RobotTrajectory& trajectory);
  MoveItErrorCode execute(const Plan& plan) { return execute(plan.trajectory_); }
  MoveItErrorCode execute(const moveit_msgs::RobotTrajectory& trajectory);
  /** Way of the end effector through poses in the reference frame, in steps [m]; returns the fraction that is possible,
   * or -1 on failure. */
  double computeCartesianPath(const std::vector<geometry_msgs::Pose>& waypoints, double eef_step, double jump_threshold,
                              moveit_msgs::RobotTrajectory& trajectory, bool avoid_collisions = true,
                              moveit_msgs::MoveItErrorCodes* error_code = nullptr);
  double computeCartesianPath(const std::vector<geometry_msgs::Pose>& waypoints, double eef_step, double jump_threshold,
                              moveit_msgs::RobotTrajectory& trajectory,
                              const moveit_msgs::Constraints& path_constraints, bool avoid_collisions = true,
                              moveit_msgs::MoveItErrorCodes* error_code = nullptr);
  void stop();
  void constructMotionPlanRequest(moveit_msgs::MotionPlanRequest& request) const;

  MoveItErrorCode pick(const std::string& object, bool plan_only = false) {
    return pick(object, std::vector<moveit_msgs::Grasp>(), plan_only);
  }
  MoveItErrorCode pick(const std::string& object, const moveit_msgs::Grasp& grasp, bool plan_only = false) {
    return pick(object, std::vector<moveit_msgs::Grasp>{grasp}, plan_only);
  }
  MoveItErrorCode pick(const std::string& object, const std::vector<moveit_msgs::Grasp>& grasps,
                       bool plan_only = false);
  MoveItErrorCode place(const std::string& object, bool plan_only = false) {
    return place(object, std::vector<moveit_msgs::PlaceLocation>(), plan_only);
  }
  MoveItErrorCode place(const std::string& object, const std::vector<moveit_msgs::PlaceLocation>& locations,
                        bool plan_only = false);
  MoveItErrorCode place(const std::string& object, const std::vector<geometry_msgs::PoseStamped>& poses,
                        bool plan_only = false);
  MoveItErrorCode place(const std::string& object, const geometry_msgs::PoseStamped& pose, bool plan_only = false) {
    return place(object, std::vector<geometry_msgs::PoseStamped>{pose}, plan_only);
  }
  /** An empty link is the end effector's. */
  bool attachObject(const std::string& object, const std::string& link = "");
  bool attachObject(const std::string& object, const std::string& link, const std::vector<std::string>& touch_links);
  /** Detach an object, or all that a link holds; false if there is none. */
  bool detachObject(const std::string& name = "");

  /** Wait for the state of all joints; false after the time. */
  bool startStateMonitor(double wait = 1.0);
  std::vector<double> getCurrentJointValues() const;
  /** Null, with an error, if joints are not told of within the time. */
  moveit::core::RobotStatePtr getCurrentState(double wait = 1) const;
  geometry_msgs::PoseStamped getCurrentPose(const std::string& end_effector_link = "") const;
  std::vector<double> getCurrentRPY(const std::string& end_effector_link = "") const;
  std::vector<double> getRandomJointValues() const;
  geometry_msgs::PoseStamped getRandomPose(const std::string& end_effector_link = "") const;
  void rememberJointValues(const std::string& name);
  void rememberJointValues(const std::string& name, const std::vector<double>& values);
  const std::map<std::string, std::vector<double>>& getRememberedJointValues() const;
  void forgetJointValues(const std::string& name);

  void setPathConstraints(const moveit_msgs::Constraints& constraint);
  moveit_msgs::Constraints getPathConstraints() const;
  void clearPathConstraints();

 private:
  class Implementation;
  std::unique_ptr<Implementation> impl_;
};

}  // namespace planning_interface
}  // namespace moveit
