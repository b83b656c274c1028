#pragma once

#include <moveit/planning_scene_monitor/planning_scene_monitor.h>
#include <moveit/robot_state/robot_state.h>
#include <moveit/robot_trajectory/robot_trajectory.h>
#include <moveit_msgs/CollisionObject.h>
#include <moveit_msgs/DisplayRobotState.h>
#include <moveit_msgs/DisplayTrajectory.h>
#include <moveit_msgs/PlanningScene.h>
#include <rviz_visual_tools/rviz_visual_tools.h>
#include <shape_msgs/Mesh.h>
#include <trajectory_msgs/JointTrajectoryPoint.h>

#include <memory>
#include <string>
#include <vector>

namespace moveit_visual_tools {

namespace rvt = rviz_visual_tools;

static const std::string ROBOT_DESCRIPTION = "robot_description";
static const std::string DISPLAY_PLANNED_PATH_TOPIC = "/move_group/display_planned_path";
static const std::string DISPLAY_ROBOT_STATE_TOPIC = "display_robot_state";
static const std::string PLANNING_SCENE_TOPIC = "planning_scene";

/** Markers of trajectories, states and paths that displays show, and objects of the scene that move_group plans in. */
class MoveItVisualTools : public rvt::RvizVisualTools {
 public:
  /** In the frame of the robot of the parameter robot_description. */
  MoveItVisualTools();
  MoveItVisualTools(const std::string& base_frame, const std::string& marker_topic,
                    const planning_scene_monitor::PlanningSceneMonitorPtr& monitor);
  /** No model: that of the parameter robot_description. */
  explicit MoveItVisualTools(const std::string& base_frame, const std::string& marker_topic = rvt::RVIZ_MARKER_TOPIC,
                             const moveit::core::RobotModelConstPtr& robot_model = moveit::core::RobotModelConstPtr());

  void setRobotStateTopic(const std::string& topic) { robot_state_topic_ = topic; }
  void setPlanningSceneTopic(const std::string& topic) { planning_scene_topic_ = topic; }
  /** move_group has the scene; this only loads the robot. */
  bool loadPlanningSceneMonitor() { return loadSharedRobotState(); }
  /** Take the robot; false, with an error, if there is none. */
  bool loadSharedRobotState();
  /** A state that may be changed, at first the default one; null if there is no robot. */
  moveit::core::RobotStatePtr& getSharedRobotState();
  moveit::core::RobotStatePtr& getRootRobotState() { return getSharedRobotState(); }
  moveit::core::RobotModelConstPtr getRobotModel();

  void loadTrajectoryPub(const std::string& topic = DISPLAY_PLANNED_PATH_TOPIC, bool blocking = true);
  void loadRobotStatePub(const std::string& topic = "", bool blocking = true);

  /** The way of a link, or of the tips of a group; false, with an error, if it is empty or the robot lacks a joint. */
  bool publishTrajectoryLine(const moveit_msgs::RobotTrajectory& trajectory, const moveit::core::LinkModel* tip,
                             const moveit::core::JointModelGroup* group, rvt::Colors color = rvt::LIME_GREEN);
  bool publishTrajectoryLine(const moveit_msgs::RobotTrajectory& trajectory, const moveit::core::JointModelGroup* group,
                             rvt::Colors color = rvt::LIME_GREEN);
  bool publishTrajectoryLine(const robot_trajectory::RobotTrajectory& trajectory, const moveit::core::LinkModel* tip,
                             rvt::Colors color = rvt::LIME_GREEN);
  bool publishTrajectoryLine(const robot_trajectory::RobotTrajectory& trajectory,
                             const moveit::core::JointModelGroup* group, rvt::Colors color = rvt::LIME_GREEN);
  bool publishTrajectoryLine(const robot_trajectory::RobotTrajectoryPtr& trajectory, const moveit::core::LinkModel* tip,
                             rvt::Colors color = rvt::LIME_GREEN) {
    return publishTrajectoryLine(*trajectory, tip, color);
  }
  bool publishTrajectoryLine(const robot_trajectory::RobotTrajectoryPtr& trajectory,
                             const moveit::core::JointModelGroup* group, rvt::Colors color = rvt::LIME_GREEN) {
    return publishTrajectoryLine(*trajectory, group, color);
  }

  /** Show the robot along a trajectory; blocking: return at its end. A speed is a time between two states [s]. */
  bool publishTrajectoryPath(const std::vector<moveit::core::RobotStatePtr>& trajectory,
                             const moveit::core::JointModelGroup* group, double speed = 0.01, bool blocking = false);
  bool publishTrajectoryPath(const robot_trajectory::RobotTrajectory& trajectory, bool blocking = false);
  bool publishTrajectoryPath(const robot_trajectory::RobotTrajectoryPtr& trajectory, bool blocking = false) {
    return publishTrajectoryPath(*trajectory, blocking);
  }
  bool publishTrajectoryPath(const moveit_msgs::RobotTrajectory& trajectory, const moveit::core::RobotState& state,
                             bool blocking = false);
  bool publishTrajectoryPath(const moveit_msgs::RobotTrajectory& trajectory,
                             const moveit::core::RobotStateConstPtr& state, bool blocking = false) {
    return publishTrajectoryPath(trajectory, *state, blocking);
  }
  bool publishTrajectoryPath(const moveit_msgs::RobotTrajectory& trajectory, const moveit_msgs::RobotState& state,
                             bool blocking = false);

  /** Show a state; no links mean that all have the color, DEFAULT the robot's own. */
  bool publishRobotState(const moveit::core::RobotState& state, rvt::Colors color = rvt::DEFAULT,
                         const std::vector<std::string>& highlight_links = {});
  bool publishRobotState(const moveit::core::RobotStatePtr& state, rvt::Colors color = rvt::DEFAULT,
                         const std::vector<std::string>& highlight_links = {}) {
    return publishRobotState(*state, color, highlight_links);
  }
  bool publishRobotState(const std::vector<double>& joint_positions, const moveit::core::JointModelGroup* group,
                         rvt::Colors color = rvt::DEFAULT);
  bool publishRobotState(const trajectory_msgs::JointTrajectoryPoint& point, const moveit::core::JointModelGroup* group,
                         rvt::Colors color = rvt::DEFAULT) {
    return publishRobotState(point.positions, group, color);
  }
  /** Show no links of it. */
  bool hideRobot();

  /** Objects of move_group's scene; poses in the base frame. */
  bool processCollisionObjectMsg(const moveit_msgs::CollisionObject& object, rvt::Colors color = rvt::GREEN);
  bool cleanupCO(const std::string& name);
  bool removeAllCollisionObjects();
  bool publishCollisionBlock(const geometry_msgs::Pose& pose, const std::string& name = "block", double size = 0.1,
                             rvt::Colors color = rvt::GREEN) {
    return publishCollisionCuboid(pose, size, size, size, name, color);
  }
  bool publishCollisionCuboid(const Eigen::Vector3d& corner, const Eigen::Vector3d& opposite, const std::string& name,
                              rvt::Colors color = rvt::GREEN);
  bool publishCollisionCuboid(const geometry_msgs::Point& corner, const geometry_msgs::Point& opposite,
                              const std::string& name, rvt::Colors color = rvt::GREEN) {
    return publishCollisionCuboid(convertPoint(corner), convertPoint(opposite), name, color);
  }
  bool publishCollisionCuboid(const Eigen::Isometry3d& pose, double width, double depth, double height,
                              const std::string& name, rvt::Colors color = rvt::GREEN) {
    return publishCollisionCuboid(convertPose(pose), width, depth, height, name, color);
  }
  bool publishCollisionCuboid(const geometry_msgs::Pose& pose, double width, double depth, double height,
                              const std::string& name, rvt::Colors color = rvt::GREEN);
  bool publishCollisionCylinder(const Eigen::Isometry3d& pose, const std::string& name, double radius, double height,
                                rvt::Colors color = rvt::GREEN) {
    return publishCollisionCylinder(convertPose(pose), name, radius, height, color);
  }
  bool publishCollisionCylinder(const geometry_msgs::Pose& pose, const std::string& name, double radius, double height,
                                rvt::Colors color = rvt::GREEN);
  bool publishCollisionMesh(const geometry_msgs::Pose& pose, const std::string& name, const shape_msgs::Mesh& mesh,
                            rvt::Colors color = rvt::GREEN);
  bool publishCollisionFloor(double z = 0.0, const std::string& plane_name = "Floor", rvt::Colors color = rvt::GREEN);
  bool publishCollisionWall(double x, double y, double angle = 0.0, double width = 2.0, double height = 1.5,
                            const std::string& name = "wall", rvt::Colors color = rvt::GREEN);
  bool triggerPlanningSceneUpdate() { return true; }

 private:
  bool publishPrimitive(const geometry_msgs::Pose& pose, int type, const std::vector<double>& dimensions,
                        const std::string& name, rvt::Colors color);
  bool publishScene(const moveit_msgs::PlanningScene& scene);

  moveit::core::RobotModelConstPtr robot_model_;
  moveit::core::RobotStatePtr state_;
  std::string robot_state_topic_ = DISPLAY_ROBOT_STATE_TOPIC, planning_scene_topic_ = PLANNING_SCENE_TOPIC;
  ros::Publisher trajectories_, robot_states_, scenes_;
};

typedef std::shared_ptr<MoveItVisualTools> MoveItVisualToolsPtr;
typedef std::shared_ptr<const MoveItVisualTools> MoveItVisualToolsConstPtr;

}  // namespace moveit_visual_tools
