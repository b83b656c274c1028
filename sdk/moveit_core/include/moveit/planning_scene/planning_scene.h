#pragma once

#include <moveit_msgs/Constraints.h>

#include <boost/function.hpp>
#include <string>

#include "moveit/collision_detection/collision_common.h"
#include "moveit/collision_detection/collision_matrix.h"
#include "moveit/robot_state/robot_state.h"

namespace planning_scene {

MOVEIT_CLASS_FORWARD(PlanningScene)

typedef boost::function<bool(const moveit::core::RobotState& state, bool verbose)> StateFeasibilityFn;

/**
 * Robot, and which of its links may touch.
 *
 * Collisions are found by the move_group that runs: its objects count, and `check_state_validity` is called for each
 * check. Pairs that this scene's matrix allows and move_group's does not are left out; the other way round they cannot
 * be known. Functions that change objects are missing: use moveit::planning_interface::PlanningSceneInterface.
 */
class PlanningScene {
 public:
  explicit PlanningScene(const moveit::core::RobotModelConstPtr& robot_model);
  PlanningScene(const urdf::ModelInterfaceSharedPtr& urdf_model, const srdf::ModelConstSharedPtr& srdf_model)
      : PlanningScene(std::make_shared<moveit::core::RobotModel>(urdf_model, srdf_model)) {}

  const std::string& getName() const { return name_; }
  void setName(const std::string& name) { name_ = name; }
  const std::string& getPlanningFrame() const { return model_->getModelFrame(); }
  const moveit::core::RobotModelConstPtr& getRobotModel() const { return model_; }
  const moveit::core::RobotState& getCurrentState() const { return state_; }
  moveit::core::RobotState& getCurrentStateNonConst() { return state_; }
  void setCurrentState(const moveit::core::RobotState& state) { state_ = state; }
  void setCurrentState(const moveit_msgs::RobotState& state);
  const Eigen::Isometry3d& getFrameTransform(const std::string& frame) const { return state_.getFrameTransform(frame); }
  bool knowsFrameTransform(const std::string& frame) const { return state_.knowsFrameTransform(frame); }
  const collision_detection::AllowedCollisionMatrix& getAllowedCollisionMatrix() const { return matrix_; }
  collision_detection::AllowedCollisionMatrix& getAllowedCollisionMatrixNonConst() { return matrix_; }

  /** Collisions of the robot with itself; raises moveit::Exception if no move_group runs. */
  void checkSelfCollision(const collision_detection::CollisionRequest& request,
                          collision_detection::CollisionResult& result) const;
  void checkSelfCollision(const collision_detection::CollisionRequest& request,
                          collision_detection::CollisionResult& result, const moveit::core::RobotState& state) const;
  void checkSelfCollision(const collision_detection::CollisionRequest& request,
                          collision_detection::CollisionResult& result, const moveit::core::RobotState& state,
                          const collision_detection::AllowedCollisionMatrix& matrix) const;
  /** Collisions of the robot with itself and with objects; raises moveit::Exception if no move_group runs. */
  void checkCollision(const collision_detection::CollisionRequest& request,
                      collision_detection::CollisionResult& result) const;
  void checkCollision(const collision_detection::CollisionRequest& request,
                      collision_detection::CollisionResult& result, const moveit::core::RobotState& state) const;
  void checkCollision(const collision_detection::CollisionRequest& request,
                      collision_detection::CollisionResult& result, const moveit::core::RobotState& state,
                      const collision_detection::AllowedCollisionMatrix& matrix) const;
  bool isStateColliding(const std::string& group = "", bool verbose = false) const {
    return isStateColliding(state_, group, verbose);
  }
  bool isStateColliding(const moveit::core::RobotState& state, const std::string& group = "",
                        bool verbose = false) const;

  void setStateFeasibilityPredicate(const StateFeasibilityFn& predicate) { is_feasible_ = predicate; }
  bool isStateFeasible(const moveit::core::RobotState& state, bool verbose = false) const {
    return !is_feasible_ || is_feasible_(state, verbose);
  }
  /** Whether move_group finds that a state keeps constraints; raises moveit::Exception if none runs. */
  bool isStateConstrained(const moveit::core::RobotState& state, const moveit_msgs::Constraints& constraints,
                          bool verbose = false) const;
  bool isStateValid(const moveit::core::RobotState& state, const std::string& group = "", bool verbose = false) const;
  bool isStateValid(const moveit::core::RobotState& state, const moveit_msgs::Constraints& constraints,
                    const std::string& group = "", bool verbose = false) const;

 private:
  void check(const collision_detection::CollisionRequest& request, collision_detection::CollisionResult& result,
             const moveit::core::RobotState& state, const collision_detection::AllowedCollisionMatrix& matrix,
             bool with_objects) const;

  std::string name_;
  moveit::core::RobotModelConstPtr model_;
  moveit::core::RobotState state_;
  collision_detection::AllowedCollisionMatrix matrix_;
  StateFeasibilityFn is_feasible_;
};

}  // namespace planning_scene
