// Moves an arm as a tutorial would; prints what move_group answers.
#include <moveit/move_group_interface/move_group_interface.h>
#include <moveit/planning_scene_interface/planning_scene_interface.h>
#include <ros/ros.h>

#include <iostream>

int main(int argc, char** argv) {
  ros::init(argc, argv, "mover");
  ros::AsyncSpinner spinner(1);
  spinner.start();

  moveit::planning_interface::MoveGroupInterface group("arm");
  moveit::planning_interface::PlanningSceneInterface scene;
  std::cout << group.getName() << ' ' << group.getPlanningFrame() << ' ' << group.getEndEffectorLink() << std::endl;
  group.setMaxVelocityScalingFactor(1.0);
  group.setMaxAccelerationScalingFactor(1.0);
  group.setNamedTarget("ready");
  std::cout << "named " << group.move().val << std::endl;

  moveit_msgs::CollisionObject table;
  table.header.frame_id = group.getPlanningFrame();
  table.id = "table";
  table.primitives.resize(1);
  table.primitives[0].type = shape_msgs::SolidPrimitive::BOX;
  table.primitives[0].dimensions = {0.4, 0.4, 0.02};
  table.primitive_poses.resize(1);
  table.primitive_poses[0].position.x = 0.9;
  table.primitive_poses[0].orientation.w = 1.0;
  table.operation = moveit_msgs::CollisionObject::ADD;
  std::cout << "table " << scene.applyCollisionObject(table) << ' ' << scene.getKnownObjectNames().size() << std::endl;

  geometry_msgs::PoseStamped goal = group.getCurrentPose();
  goal.pose.position.z += 0.1;
  group.setPoseTarget(goal);
  moveit::planning_interface::MoveGroupInterface::Plan plan;
  const bool is_planned = group.plan(plan) == moveit::planning_interface::MoveItErrorCode::SUCCESS;
  std::cout << "plan " << is_planned << ' ' << (plan.trajectory_.joint_trajectory.points.size() > 1) << std::endl;
  std::cout << "execute " << group.execute(plan).val << std::endl;
  const double error = group.getCurrentPose().pose.position.z - goal.pose.position.z;
  std::cout << "reached " << (std::abs(error) < 0.01) << std::endl;

  std::vector<geometry_msgs::Pose> waypoints = {goal.pose};
  waypoints[0].position.z -= 0.1;
  moveit_msgs::RobotTrajectory trajectory;
  std::cout << "cartesian " << group.computeCartesianPath(waypoints, 0.01, 0.0, trajectory) << std::endl;
  goal.pose.position.x = 9.0;
  group.setPoseTarget(goal);
  std::cout << "far " << (group.move() == moveit::planning_interface::MoveItErrorCode::SUCCESS) << std::endl;
  scene.clear();
  std::cout << "cleared " << scene.getKnownObjectNames().size() << std::endl;
  return 0;
}
