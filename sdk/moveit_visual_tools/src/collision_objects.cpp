#include <shape_msgs/SolidPrimitive.h>

#include <algorithm>
#include <cmath>

#include "moveit_visual_tools/moveit_visual_tools.h"

namespace moveit_visual_tools {
namespace {

using moveit_msgs::CollisionObject;
using shape_msgs::SolidPrimitive;

constexpr double kFloorSize = 10.0;      // [m]
constexpr double kPlaneThickness = 0.1;  // [m]
constexpr double kSmallest = 1e-4;       // [m], of a side

geometry_msgs::Pose poseOf(double x, double y, double z, double angle) {
  geometry_msgs::Pose pose;
  pose.position.x = x;
  pose.position.y = y;
  pose.position.z = z;
  pose.orientation.z = std::sin(angle / 2.0);
  pose.orientation.w = std::cos(angle / 2.0);
  return pose;
}

}  // namespace

bool MoveItVisualTools::publishScene(const moveit_msgs::PlanningScene& scene) {
  if (!scenes_) {
    scenes_ = nh_.advertise<moveit_msgs::PlanningScene>(planning_scene_topic_, 100);
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(5.0);
    while (ros::ok() && scenes_.getNumSubscribers() == 0 && ros::WallTime::now() < end) ros::WallDuration(0.01).sleep();
  }
  scenes_.publish(scene);
  return true;
}

bool MoveItVisualTools::processCollisionObjectMsg(const CollisionObject& object, rvt::Colors color) {
  moveit_msgs::PlanningScene scene;
  scene.is_diff = true;
  scene.robot_state.is_diff = true;
  scene.world.collision_objects.push_back(object);
  if (object.operation == CollisionObject::ADD) {
    moveit_msgs::ObjectColor colored;
    colored.id = object.id;
    colored.color = getColor(color);
    scene.object_colors.push_back(colored);
  }
  return publishScene(scene);
}

bool MoveItVisualTools::cleanupCO(const std::string& name) {
  CollisionObject object;
  object.header.frame_id = base_frame_;
  object.id = name;
  object.operation = CollisionObject::REMOVE;
  return processCollisionObjectMsg(object);
}

bool MoveItVisualTools::removeAllCollisionObjects() { return cleanupCO(""); }

bool MoveItVisualTools::publishPrimitive(const geometry_msgs::Pose& pose, int type,
                                         const std::vector<double>& dimensions, const std::string& name,
                                         rvt::Colors color) {
  CollisionObject object;
  object.header.frame_id = base_frame_;
  object.header.stamp = ros::Time::now();
  object.id = name;
  object.operation = CollisionObject::ADD;
  object.primitives.resize(1);
  object.primitives[0].type = static_cast<std::uint8_t>(type);
  for (const double size : dimensions) object.primitives[0].dimensions.push_back(std::max(size, kSmallest));
  object.primitive_poses.push_back(pose);
  return processCollisionObjectMsg(object, color);
}

bool MoveItVisualTools::publishCollisionCuboid(const Eigen::Vector3d& corner, const Eigen::Vector3d& opposite,
                                               const std::string& name, rvt::Colors color) {
  const Eigen::Vector3d size = (opposite - corner).cwiseAbs(), center = (corner + opposite) / 2.0;
  return publishCollisionCuboid(poseOf(center.x(), center.y(), center.z(), 0.0), size.x(), size.y(), size.z(), name,
                                color);
}

bool MoveItVisualTools::publishCollisionCuboid(const geometry_msgs::Pose& pose, double width, double depth,
                                               double height, const std::string& name, rvt::Colors color) {
  return publishPrimitive(pose, SolidPrimitive::BOX, {width, depth, height}, name, color);
}

bool MoveItVisualTools::publishCollisionCylinder(const geometry_msgs::Pose& pose, const std::string& name,
                                                 double radius, double height, rvt::Colors color) {
  return publishPrimitive(pose, SolidPrimitive::CYLINDER, {height, radius}, name, color);
}

bool MoveItVisualTools::publishCollisionMesh(const geometry_msgs::Pose& pose, const std::string& name,
                                             const shape_msgs::Mesh& mesh, rvt::Colors color) {
  CollisionObject object;
  object.header.frame_id = base_frame_;
  object.header.stamp = ros::Time::now();
  object.id = name;
  object.operation = CollisionObject::ADD;
  object.meshes.push_back(mesh);
  object.mesh_poses.push_back(pose);
  return processCollisionObjectMsg(object, color);
}

bool MoveItVisualTools::publishCollisionFloor(double z, const std::string& plane_name, rvt::Colors color) {
  return publishCollisionCuboid(poseOf(0.0, 0.0, z - kPlaneThickness / 2.0, 0.0), kFloorSize, kFloorSize,
                                kPlaneThickness, plane_name, color);
}

bool MoveItVisualTools::publishCollisionWall(double x, double y, double angle, double width, double height,
                                             const std::string& name, rvt::Colors color) {
  return publishCollisionCuboid(poseOf(x, y, height / 2.0, angle), kPlaneThickness, width, height, name, color);
}

}  // namespace moveit_visual_tools
