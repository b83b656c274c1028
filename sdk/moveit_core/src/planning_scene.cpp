#include "moveit/planning_scene/planning_scene.h"

#include <moveit_msgs/GetStateValidity.h>
#include <ros/service.h>

#include "moveit/robot_state/conversions.h"

namespace planning_scene {
namespace {

using collision_detection::AllowedCollisionMatrix;
using collision_detection::BodyType;
using collision_detection::CollisionRequest;
using collision_detection::CollisionResult;
using collision_detection::Contact;
using collision_detection::AllowedCollision::Type;
using moveit::core::RobotState;

moveit_msgs::GetStateValidity::Response askMoveGroup(const RobotState& state, const std::string& group,
                                                     const moveit_msgs::Constraints& constraints) {
  moveit_msgs::GetStateValidity question;
  moveit::core::robotStateToRobotStateMsg(state, question.request.robot_state);
  question.request.group_name = group;
  question.request.constraints = constraints;
  if (!ros::service::call("check_state_validity", question)) {
    throw moveit::Exception("collisions are checked by move_group, whose service " +
                            ros::names::resolve("check_state_validity") + " does not answer; start move_group first");
  }
  return question.response;
}

Contact contactOf(const moveit_msgs::ContactInformation& message) {
  Contact result;
  result.pos = {message.position.x, message.position.y, message.position.z};
  result.normal = {message.normal.x, message.normal.y, message.normal.z};
  result.depth = message.depth;
  result.body_name_1 = message.contact_body_1;
  result.body_name_2 = message.contact_body_2;
  result.body_type_1 = static_cast<BodyType>(message.body_type_1);
  result.body_type_2 = static_cast<BodyType>(message.body_type_2);
  return result;
}

}  // namespace

PlanningScene::PlanningScene(const moveit::core::RobotModelConstPtr& robot_model)
    : model_(robot_model), state_(robot_model) {
  std::vector<std::string> links;
  for (const moveit::core::LinkModel* link : model_->getLinkModels())
    if (link->hasCollisionGeometry()) links.push_back(link->getName());
  matrix_.setEntry(links, links, false);
  for (const auto& pair : model_->getSRDF()->getDisabledCollisionPairs())
    matrix_.setEntry(pair.link1_, pair.link2_, true);
}

void PlanningScene::setCurrentState(const moveit_msgs::RobotState& state) {
  moveit::core::robotStateMsgToRobotState(state, state_);
}

void PlanningScene::check(const CollisionRequest& request, CollisionResult& result, const RobotState& state,
                          const AllowedCollisionMatrix& matrix, bool with_objects) const {
  for (const moveit_msgs::ContactInformation& message :
       askMoveGroup(state, request.group_name, moveit_msgs::Constraints()).contacts) {
    const Contact contact = contactOf(message);
    const bool has_object = contact.body_type_1 == collision_detection::BodyTypes::WORLD_OBJECT ||
                            contact.body_type_2 == collision_detection::BodyTypes::WORLD_OBJECT;
    if (has_object && !with_objects) continue;
    Type type = collision_detection::AllowedCollision::NEVER;
    if (matrix.getAllowedCollision(contact.body_name_1, contact.body_name_2, type) &&
        type == collision_detection::AllowedCollision::ALWAYS) {
      continue;
    }
    result.collision = true;
    if (!request.contacts || result.contact_count >= request.max_contacts) continue;
    const auto names = std::minmax(contact.body_name_1, contact.body_name_2);
    std::vector<Contact>& of_pair = result.contacts[{names.first, names.second}];
    if (of_pair.size() >= request.max_contacts_per_pair) continue;
    of_pair.push_back(contact);
    ++result.contact_count;
  }
}

void PlanningScene::checkSelfCollision(const CollisionRequest& request, CollisionResult& result) const {
  check(request, result, state_, matrix_, false);
}
void PlanningScene::checkSelfCollision(const CollisionRequest& request, CollisionResult& result,
                                       const RobotState& state) const {
  check(request, result, state, matrix_, false);
}
void PlanningScene::checkSelfCollision(const CollisionRequest& request, CollisionResult& result,
                                       const RobotState& state, const AllowedCollisionMatrix& matrix) const {
  check(request, result, state, matrix, false);
}
void PlanningScene::checkCollision(const CollisionRequest& request, CollisionResult& result) const {
  check(request, result, state_, matrix_, true);
}
void PlanningScene::checkCollision(const CollisionRequest& request, CollisionResult& result,
                                   const RobotState& state) const {
  check(request, result, state, matrix_, true);
}
void PlanningScene::checkCollision(const CollisionRequest& request, CollisionResult& result, const RobotState& state,
                                   const AllowedCollisionMatrix& matrix) const {
  check(request, result, state, matrix, true);
}

bool PlanningScene::isStateColliding(const RobotState& state, const std::string& group, bool verbose) const {
  CollisionRequest request;
  request.group_name = group;
  request.verbose = verbose;
  CollisionResult result;
  checkCollision(request, result, state);
  return result.collision;
}

bool PlanningScene::isStateConstrained(const RobotState& state, const moveit_msgs::Constraints& constraints,
                                       bool) const {
  for (const auto& one : askMoveGroup(state, "", constraints).constraint_result)
    if (!one.result) return false;
  return true;
}

bool PlanningScene::isStateValid(const RobotState& state, const std::string& group, bool verbose) const {
  return isStateFeasible(state, verbose) && !isStateColliding(state, group, verbose);
}

bool PlanningScene::isStateValid(const RobotState& state, const moveit_msgs::Constraints& constraints,
                                 const std::string& group, bool verbose) const {
  return isStateValid(state, group, verbose) && isStateConstrained(state, constraints, verbose);
}

}  // namespace planning_scene
