#pragma once

#include <moveit_msgs/JointLimits.h>
#include <Eigen/Geometry>

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

namespace moveit {
namespace core {

class LinkModel;
class RobotModel;

/** Limits of a variable: [m or rad], [m/s or rad/s], [m/s² or rad/s²]. */
struct VariableBounds {
  double min_position_ = 0.0, max_position_ = 0.0;
  bool position_bounded_ = false;
  double min_velocity_ = 0.0, max_velocity_ = 0.0;
  bool velocity_bounded_ = false;
  double min_acceleration_ = 0.0, max_acceleration_ = 0.0;
  bool acceleration_bounded_ = false;
};

/** Joint of a robot; its variables are consecutive in a state. */
class JointModel {
 public:
  enum JointType { UNKNOWN, REVOLUTE, PRISMATIC, PLANAR, FLOATING, FIXED };
  typedef std::vector<VariableBounds> Bounds;

  const std::string& getName() const { return name_; }
  JointType getType() const { return type_; }
  std::string getTypeName() const;
  bool isContinuous() const { return is_continuous_; }
  const Eigen::Vector3d& getAxis() const { return axis_; }
  const LinkModel* getParentLinkModel() const { return parent_; }
  const LinkModel* getChildLinkModel() const { return child_; }

  /** `name` for one variable; `name/x`, `name/y`, `name/theta` of a planar joint; `name/trans_x` … `name/rot_w` of a
   * floating one. */
  const std::vector<std::string>& getVariableNames() const { return variables_; }
  std::size_t getVariableCount() const { return variables_.size(); }
  std::size_t getStateSpaceDimension() const { return type_ == FLOATING ? 6 : variables_.size(); }
  bool hasVariable(const std::string& variable) const;
  const Bounds& getVariableBounds() const { return bounds_; }
  /** Raises std::out_of_range for a variable that the joint lacks. */
  const VariableBounds& getVariableBounds(const std::string& variable) const;
  std::vector<moveit_msgs::JointLimits> getVariableBoundsMsg() const;
  void setVariableBounds(const std::string& variable, const VariableBounds& bounds);
  std::size_t getFirstVariableIndex() const { return first_variable_; }
  int getJointIndex() const { return index_; }
  bool satisfiesPositionBounds(const double* values, double margin = 0.0) const;
  /** Move values into the limits; returns whether one changed. */
  bool enforcePositionBounds(double* values) const;
  double distance(const double* values1, const double* values2) const;
  void interpolate(const double* from, const double* to, double t, double* state) const;

  const JointModel* getMimic() const { return mimic_; }
  double getMimicOffset() const { return mimic_offset_; }
  double getMimicFactor() const { return mimic_factor_; }
  bool isPassive() const { return is_passive_; }

  /** Pose of the child link in the joint's frame. */
  Eigen::Isometry3d computeTransform(const double* values) const;

 private:
  friend class RobotModel;

  std::string name_;
  JointType type_ = UNKNOWN;
  bool is_continuous_ = false, is_passive_ = false;
  Eigen::Vector3d axis_ = Eigen::Vector3d::UnitX();
  Eigen::Isometry3d origin_ = Eigen::Isometry3d::Identity();
  const LinkModel* parent_ = nullptr;
  const LinkModel* child_ = nullptr;
  std::vector<std::string> variables_;
  Bounds bounds_;
  std::size_t first_variable_ = 0;
  int index_ = 0;
  const JointModel* mimic_ = nullptr;
  double mimic_offset_ = 0.0, mimic_factor_ = 1.0;
};

typedef std::vector<const JointModel::Bounds*> JointBoundsVector;
std::ostream& operator<<(std::ostream& out, const VariableBounds& bounds);

}  // namespace core
}  // namespace moveit
