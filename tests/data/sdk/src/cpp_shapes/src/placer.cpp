// Puts a mesh of a package into the scene of move_group, and prints whether it is there.
#include <geometric_shapes/shape_operations.h>
#include <moveit/planning_scene_interface/planning_scene_interface.h>
#include <ros/ros.h>

#include <iostream>

int main(int argc, char** argv) {
  ros::init(argc, argv, "placer");
  ros::NodeHandle node;
  shapes::Mesh* loaded = shapes::createMeshFromResource("package://cpp_shapes/meshes/wedge.stl", Eigen::Vector3d(0.1, 0.1, 0.1));
  shapes::ShapeMsg message;
  shapes::constructMsgFromShape(loaded, message);
  delete loaded;

  moveit_msgs::CollisionObject object;
  object.header.frame_id = "world";
  object.id = "wedge";
  object.operation = moveit_msgs::CollisionObject::ADD;
  object.meshes.push_back(boost::get<shape_msgs::Mesh>(message));
  object.mesh_poses.resize(1);
  object.mesh_poses[0].position.x = 0.7;
  object.mesh_poses[0].orientation.w = 1.0;
  moveit::planning_interface::PlanningSceneInterface scene;
  std::cout << "applied " << scene.applyCollisionObject(object) << std::endl;
  const auto objects = scene.getObjects({"wedge"});
  for (const auto& entry : objects)
    std::cout << entry.first << " " << entry.second.meshes.size() << " " << entry.second.meshes[0].vertices.size() << " "
              << entry.second.meshes[0].triangles.size() << std::endl;
}
