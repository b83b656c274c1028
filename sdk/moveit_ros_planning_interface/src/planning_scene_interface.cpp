#include "moveit/planning_scene_interface/planning_scene_interface.h"

#include <moveit_msgs/ApplyPlanningScene.h>
#include <moveit_msgs/GetPlanningScene.h>

#include <algorithm>

namespace moveit {
namespace planning_interface {
namespace {

using moveit_msgs::PlanningSceneComponents;

moveit_msgs::PlanningScene difference() {
  moveit_msgs::PlanningScene scene;
  scene.is_diff = true;
  scene.robot_state.is_diff = true;
  return scene;
}

/** Colors of objects; one without a name has that of its object. */
std::vector<moveit_msgs::ObjectColor> named(std::vector<moveit_msgs::ObjectColor> colors,
                                            const std::vector<moveit_msgs::CollisionObject>& objects) {
  for (std::size_t i = 0; i < std::min(colors.size(), objects.size()); ++i)
    if (colors[i].id.empty()) colors[i].id = objects[i].id;
  return colors;
}

bool isWanted(const std::vector<std::string>& wanted, const std::string& id) {
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), id) != wanted.end();
}

bool isNull(const geometry_msgs::Pose& pose) {
  const auto& q = pose.orientation;
  return q.x == 0.0 && q.y == 0.0 && q.z == 0.0 && q.w == 0.0;
}

/** Poses of an object's shapes, in the frame of the object's pose where it has one (Noetic), else in the header's. */
std::vector<geometry_msgs::Pose> shapePoses(const moveit_msgs::CollisionObject& object) {
  std::vector<geometry_msgs::Pose> result = object.primitive_poses;
  result.insert(result.end(), object.mesh_poses.begin(), object.mesh_poses.end());
  return result;
}

}  // namespace

PlanningSceneInterface::PlanningSceneInterface(const std::string& ns, bool wait)
    : node_(ns),
      get_scene_(node_.serviceClient<moveit_msgs::GetPlanningScene>("get_planning_scene")),
      apply_scene_(node_.serviceClient<moveit_msgs::ApplyPlanningScene>("apply_planning_scene")),
      changes_(node_.advertise<moveit_msgs::PlanningScene>("planning_scene", 1)) {
  if (!wait) return;
  for (ros::ServiceClient* client : {&get_scene_, &apply_scene_}) {
    if (client->waitForExistence(ros::Duration(5.0))) continue;
    ROS_INFO_NAMED("planning_scene_interface", "waiting for move_group's service %s", client->getService().c_str());
    client->waitForExistence();
  }
}

moveit_msgs::PlanningScene PlanningSceneInterface::getScene(unsigned int components) {
  moveit_msgs::GetPlanningScene question;
  question.request.components.components = components;
  if (!get_scene_.call(question))
    ROS_WARN_NAMED("planning_scene_interface", "Could not call planning scene service to get object names");
  return question.response.scene;
}

std::vector<std::string> PlanningSceneInterface::getKnownObjectNames(bool with_type) {
  std::vector<std::string> result;
  for (const auto& object : getScene(PlanningSceneComponents::WORLD_OBJECT_NAMES).world.collision_objects)
    if (!with_type || !object.type.key.empty()) result.push_back(object.id);
  return result;
}

std::vector<std::string> PlanningSceneInterface::getKnownObjectNamesInROI(double minx, double miny, double minz,
                                                                          double maxx, double maxy, double maxz,
                                                                          bool with_type,
                                                                          std::vector<std::string>& types) {
  std::vector<std::string> result;
  types.clear();
  for (const auto& object : getScene(PlanningSceneComponents::WORLD_OBJECT_GEOMETRY).world.collision_objects) {
    if (with_type && object.type.key.empty()) continue;
    const std::vector<geometry_msgs::Pose> poses = shapePoses(object);
    const bool is_inside = std::any_of(poses.begin(), poses.end(), [&](const geometry_msgs::Pose& pose) {
      const double x = object.pose.position.x + pose.position.x, y = object.pose.position.y + pose.position.y,
                   z = object.pose.position.z + pose.position.z;
      return x >= minx && x <= maxx && y >= miny && y <= maxy && z >= minz && z <= maxz;
    });
    if (!is_inside) continue;
    result.push_back(object.id);
    if (with_type) types.push_back(object.type.key);
  }
  return result;
}

std::map<std::string, geometry_msgs::Pose> PlanningSceneInterface::getObjectPoses(
    const std::vector<std::string>& object_ids) {
  std::map<std::string, geometry_msgs::Pose> result;
  for (const auto& object : getScene(PlanningSceneComponents::WORLD_OBJECT_GEOMETRY).world.collision_objects) {
    if (std::find(object_ids.begin(), object_ids.end(), object.id) == object_ids.end()) continue;
    const std::vector<geometry_msgs::Pose> poses = shapePoses(object);
    result[object.id] = isNull(object.pose) && !poses.empty() ? poses.front() : object.pose;
  }
  return result;
}

std::map<std::string, moveit_msgs::CollisionObject> PlanningSceneInterface::getObjects(
    const std::vector<std::string>& object_ids) {
  std::map<std::string, moveit_msgs::CollisionObject> result;
  for (const auto& object : getScene(PlanningSceneComponents::WORLD_OBJECT_GEOMETRY).world.collision_objects)
    if (isWanted(object_ids, object.id)) result[object.id] = object;
  return result;
}

std::map<std::string, moveit_msgs::AttachedCollisionObject> PlanningSceneInterface::getAttachedObjects(
    const std::vector<std::string>& object_ids) {
  std::map<std::string, moveit_msgs::AttachedCollisionObject> result;
  for (const auto& body :
       getScene(PlanningSceneComponents::ROBOT_STATE_ATTACHED_OBJECTS).robot_state.attached_collision_objects) {
    if (isWanted(object_ids, body.object.id)) result[body.object.id] = body;
  }
  return result;
}

bool PlanningSceneInterface::applyCollisionObject(const moveit_msgs::CollisionObject& object,
                                                  const std_msgs::ColorRGBA& color) {
  moveit_msgs::ObjectColor named_color;
  named_color.id = object.id;
  named_color.color = color;
  return applyCollisionObjects({object}, {named_color});
}

bool PlanningSceneInterface::applyCollisionObjects(const std::vector<moveit_msgs::CollisionObject>& objects,
                                                   const std::vector<moveit_msgs::ObjectColor>& colors) {
  moveit_msgs::PlanningScene scene = difference();
  scene.world.collision_objects = objects;
  scene.object_colors = named(colors, objects);
  return applyPlanningScene(scene);
}

bool PlanningSceneInterface::applyAttachedCollisionObjects(
    const std::vector<moveit_msgs::AttachedCollisionObject>& objects) {
  moveit_msgs::PlanningScene scene = difference();
  scene.robot_state.attached_collision_objects = objects;
  return applyPlanningScene(scene);
}

bool PlanningSceneInterface::applyPlanningScene(const moveit_msgs::PlanningScene& scene) {
  moveit_msgs::ApplyPlanningScene question;
  question.request.scene = scene;
  if (!apply_scene_.call(question)) {
    ROS_WARN_NAMED("planning_scene_interface", "Failed to call ApplyPlanningScene service");
    return false;
  }
  return question.response.success;
}

void PlanningSceneInterface::addCollisionObjects(const std::vector<moveit_msgs::CollisionObject>& objects,
                                                 const std::vector<moveit_msgs::ObjectColor>& colors) const {
  moveit_msgs::PlanningScene scene = difference();
  scene.world.collision_objects = objects;
  scene.object_colors = named(colors, objects);
  changes_.publish(scene);
}

void PlanningSceneInterface::removeCollisionObjects(const std::vector<std::string>& object_ids) const {
  moveit_msgs::PlanningScene scene = difference();
  for (const std::string& id : object_ids) {
    moveit_msgs::CollisionObject object;
    object.id = id;
    object.operation = moveit_msgs::CollisionObject::REMOVE;
    scene.world.collision_objects.push_back(object);
  }
  changes_.publish(scene);
}

bool PlanningSceneInterface::clear() {
  moveit_msgs::PlanningScene scene = difference();
  for (const auto& entry : getAttachedObjects()) {
    moveit_msgs::AttachedCollisionObject body;
    body.link_name = entry.second.link_name;
    body.object.id = entry.first;
    body.object.operation = moveit_msgs::CollisionObject::REMOVE;
    scene.robot_state.attached_collision_objects.push_back(body);
  }
  moveit_msgs::CollisionObject all;  // one without a name
  all.operation = moveit_msgs::CollisionObject::REMOVE;
  scene.world.collision_objects.push_back(all);
  return applyPlanningScene(scene);
}

}  // namespace planning_interface
}  // namespace moveit
