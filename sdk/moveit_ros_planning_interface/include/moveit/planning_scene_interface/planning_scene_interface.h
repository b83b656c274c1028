#pragma once

#include <moveit_msgs/AttachedCollisionObject.h>
#include <moveit_msgs/CollisionObject.h>
#include <moveit_msgs/ObjectColor.h>
#include <moveit_msgs/PlanningScene.h>
#include <ros/ros.h>

#include <map>
#include <string>
#include <vector>

#include "moveit/macros/class_forward.h"

namespace moveit {
namespace planning_interface {

MOVEIT_CLASS_FORWARD(PlanningSceneInterface)

/** Objects of the scene in which move_group plans. */
class PlanningSceneInterface {
 public:
  /** Wait for move_group's services, unless told not to. */
  explicit PlanningSceneInterface(const std::string& ns = "", bool wait = true);

  std::vector<std::string> getKnownObjectNames(bool with_type = false);
  /** Objects with a shape whose center is in a box [m]. */
  std::vector<std::string> getKnownObjectNamesInROI(double minx, double miny, double minz, double maxx, double maxy,
                                                    double maxz, bool with_type, std::vector<std::string>& types);
  std::vector<std::string> getKnownObjectNamesInROI(double minx, double miny, double minz, double maxx, double maxy,
                                                    double maxz, bool with_type = false) {
    std::vector<std::string> types;
    return getKnownObjectNamesInROI(minx, miny, minz, maxx, maxy, maxz, with_type, types);
  }
  std::map<std::string, geometry_msgs::Pose> getObjectPoses(const std::vector<std::string>& object_ids);
  /** No names mean all objects. */
  std::map<std::string, moveit_msgs::CollisionObject> getObjects(const std::vector<std::string>& object_ids = {});
  std::map<std::string, moveit_msgs::AttachedCollisionObject> getAttachedObjects(
      const std::vector<std::string>& object_ids = {});

  /** Change the scene, and return once it is changed; false if move_group refuses. */
  bool applyCollisionObject(const moveit_msgs::CollisionObject& object) { return applyCollisionObjects({object}); }
  bool applyCollisionObject(const moveit_msgs::CollisionObject& object, const std_msgs::ColorRGBA& color);
  bool applyCollisionObjects(const std::vector<moveit_msgs::CollisionObject>& objects,
                             const std::vector<moveit_msgs::ObjectColor>& colors = {});
  bool applyAttachedCollisionObject(const moveit_msgs::AttachedCollisionObject& object) {
    return applyAttachedCollisionObjects({object});
  }
  bool applyAttachedCollisionObjects(const std::vector<moveit_msgs::AttachedCollisionObject>& objects);
  bool applyPlanningScene(const moveit_msgs::PlanningScene& scene);

  /** Change the scene by a message, and return at once. */
  void addCollisionObjects(const std::vector<moveit_msgs::CollisionObject>& objects,
                           const std::vector<moveit_msgs::ObjectColor>& colors = {}) const;
  void removeCollisionObjects(const std::vector<std::string>& object_ids) const;
  /** Remove all objects, attached ones too. */
  bool clear();

 private:
  moveit_msgs::PlanningScene getScene(unsigned int components);

  mutable ros::NodeHandle node_;
  ros::ServiceClient get_scene_, apply_scene_;
  ros::Publisher changes_;
};

}  // namespace planning_interface
}  // namespace moveit
