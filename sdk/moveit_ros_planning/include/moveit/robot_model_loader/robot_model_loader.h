#pragma once

#include <string>

#include "moveit/macros/class_forward.h"
#include "moveit/robot_model/robot_model.h"

namespace robot_model_loader {

MOVEIT_CLASS_FORWARD(RobotModelLoader)

/** Robot of parameters: NAME its URDF, NAME_semantic its SRDF, NAME_planning/joint_limits limits that replace the
 * URDF's. */
class RobotModelLoader {
 public:
  struct Options {
    explicit Options(const std::string& robot_description = "robot_description")
        : robot_description_(robot_description) {}
    Options(const std::string& urdf_string, const std::string& srdf_string)
        : urdf_string_(urdf_string), srdf_string_(srdf_string) {}

    std::string robot_description_, urdf_string_, srdf_string_;
    bool load_kinematics_solvers_ = true;
  };

  explicit RobotModelLoader(const Options& options = Options()) { load(options); }
  /** Inverse kinematics need no solver to be loaded. */
  explicit RobotModelLoader(const std::string& robot_description, bool load_kinematics_solvers = true) {
    Options options(robot_description);
    options.load_kinematics_solvers_ = load_kinematics_solvers;
    load(options);
  }

  /** Null, with an error, if a parameter is missing or invalid. */
  const moveit::core::RobotModelPtr& getModel() const { return model_; }
  const std::string& getRobotDescription() const { return robot_description_; }
  const urdf::ModelInterfaceSharedPtr& getURDF() const { return urdf_; }
  const srdf::ModelSharedPtr& getSRDF() const { return srdf_; }

 private:
  void load(const Options& options);
  void readJointLimits();

  std::string robot_description_;
  urdf::ModelInterfaceSharedPtr urdf_;
  srdf::ModelSharedPtr srdf_;
  moveit::core::RobotModelPtr model_;
};

}  // namespace robot_model_loader
