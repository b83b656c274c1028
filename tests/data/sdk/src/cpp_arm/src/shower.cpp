// Shows the way of an arm's trajectory as a tutorial would, step by step; prints its steps.
#include <moveit_visual_tools/moveit_visual_tools.h>
#include <ros/ros.h>

#include <iostream>

namespace rvt = rviz_visual_tools;

int main(int argc, char** argv) {
  ros::init(argc, argv, "shower");
  ros::AsyncSpinner spinner(1);
  spinner.start();

  moveit_visual_tools::MoveItVisualTools visual_tools("base");
  visual_tools.waitForMarkerSub();
  visual_tools.deleteAllMarkers();
  visual_tools.loadRemoteControl();
  const moveit::core::JointModelGroup* arm = visual_tools.getRobotModel()->getJointModelGroup("arm");
  Eigen::Affine3d text_pose = Eigen::Affine3d::Identity();
  text_pose.translation().z() = 1.5;
  visual_tools.publishText(text_pose, "Way of the tip", rvt::WHITE, rvt::XLARGE);
  visual_tools.publishAxisLabeled(visual_tools.getSharedRobotState()->getGlobalLinkTransform("l6"), "tip");

  moveit_msgs::RobotTrajectory trajectory;
  trajectory.joint_trajectory.joint_names = arm->getActiveJointModelNames();
  trajectory.joint_trajectory.points.resize(2);
  trajectory.joint_trajectory.points[0].positions.assign(6, 0.0);
  trajectory.joint_trajectory.points[1].positions = {0.0, M_PI / 2.0, 0.0, 0.0, 0.0, 0.0};
  std::cout << "line " << visual_tools.publishTrajectoryLine(trajectory, arm) << std::endl;
  visual_tools.trigger();
  visual_tools.prompt("see the line");

  visual_tools.publishRobotState(trajectory.joint_trajectory.points[1], arm, rvt::RED);
  visual_tools.publishTrajectoryPath(trajectory, *visual_tools.getSharedRobotState());
  visual_tools.publishCollisionCuboid(Eigen::Vector3d(0.5, -0.1, 0.0), Eigen::Vector3d(0.7, 0.1, 0.4), "block");
  visual_tools.prompt("see the block");
  std::cout << "short " << visual_tools.publishRobotState(std::vector<double>(5), arm) << std::endl;
  std::cout << "empty " << visual_tools.publishTrajectoryLine(moveit_msgs::RobotTrajectory(), arm) << std::endl;
  return 0;
}
