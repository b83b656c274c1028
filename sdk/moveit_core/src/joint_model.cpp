#include "moveit/robot_model/joint_model.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>

namespace moveit {
namespace core {
namespace {

constexpr double kTurn = 2.0 * M_PI;

Eigen::Quaterniond rotation(const double* values) { return {values[6], values[3], values[4], values[5]}; }

/** Angle in [-π, π]. */
double wrapped(double angle) { return std::remainder(angle, kTurn); }

}  // namespace

std::string JointModel::getTypeName() const {
  switch (type_) {
    case UNKNOWN: return "Unknown";
    case REVOLUTE: return "Revolute";
    case PRISMATIC: return "Prismatic";
    case PLANAR: return "Planar";
    case FLOATING: return "Floating";
    case FIXED: return "Fixed";
  }
  return "[Unkown]";
}

bool JointModel::hasVariable(const std::string& variable) const {
  return std::find(variables_.begin(), variables_.end(), variable) != variables_.end();
}

const VariableBounds& JointModel::getVariableBounds(const std::string& variable) const {
  const auto found = std::find(variables_.begin(), variables_.end(), variable);
  if (found == variables_.end()) throw std::out_of_range("joint '" + name_ + "' has no variable '" + variable + "'");
  return bounds_[static_cast<std::size_t>(found - variables_.begin())];
}

void JointModel::setVariableBounds(const std::string& variable, const VariableBounds& bounds) {
  const VariableBounds& known = getVariableBounds(variable);
  bounds_[static_cast<std::size_t>(&known - bounds_.data())] = bounds;
}

std::vector<moveit_msgs::JointLimits> JointModel::getVariableBoundsMsg() const {
  std::vector<moveit_msgs::JointLimits> result;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    moveit_msgs::JointLimits limits;
    limits.joint_name = variables_[i];
    limits.has_position_limits = bounds_[i].position_bounded_;
    limits.min_position = bounds_[i].min_position_;
    limits.max_position = bounds_[i].max_position_;
    limits.has_velocity_limits = bounds_[i].velocity_bounded_;
    limits.max_velocity = std::min(std::abs(bounds_[i].min_velocity_), std::abs(bounds_[i].max_velocity_));
    limits.has_acceleration_limits = bounds_[i].acceleration_bounded_;
    limits.max_acceleration = std::min(std::abs(bounds_[i].min_acceleration_), std::abs(bounds_[i].max_acceleration_));
    result.push_back(limits);
  }
  return result;
}

bool JointModel::satisfiesPositionBounds(const double* values, double margin) const {
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    if (!bounds_[i].position_bounded_) continue;
    if (values[i] < bounds_[i].min_position_ - margin || values[i] > bounds_[i].max_position_ + margin) return false;
  }
  return true;
}

bool JointModel::enforcePositionBounds(double* values) const {
  bool is_changed = false;
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    const double before = values[i];
    if (bounds_[i].position_bounded_)
      values[i] = std::clamp(values[i], bounds_[i].min_position_, bounds_[i].max_position_);
    if (is_continuous_ || (type_ == PLANAR && i == 2)) values[i] = wrapped(values[i]);
    is_changed = is_changed || values[i] != before;
  }
  if (type_ == FLOATING) {
    const Eigen::Quaterniond q = rotation(values);
    if (std::abs(q.squaredNorm() - 1.0) > 1e-9) {
      const Eigen::Vector4d unit =
          q.squaredNorm() > 0.0 ? Eigen::Vector4d(q.coeffs().normalized()) : Eigen::Vector4d(0, 0, 0, 1);
      std::copy(unit.data(), unit.data() + 4, values + 3);
      is_changed = true;
    }
  }
  return is_changed;
}

double JointModel::distance(const double* values1, const double* values2) const {
  switch (type_) {
    case REVOLUTE: return std::abs(is_continuous_ ? wrapped(values1[0] - values2[0]) : values1[0] - values2[0]);
    case PRISMATIC: return std::abs(values1[0] - values2[0]);
    case PLANAR:
      return std::hypot(values1[0] - values2[0], values1[1] - values2[1]) + std::abs(wrapped(values1[2] - values2[2]));
    case FLOATING:
      return (Eigen::Map<const Eigen::Vector3d>(values1) - Eigen::Map<const Eigen::Vector3d>(values2)).norm() +
             rotation(values1).angularDistance(rotation(values2));
    default: return 0.0;
  }
}

void JointModel::interpolate(const double* from, const double* to, double t, double* state) const {
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const bool turns = is_continuous_ || (type_ == PLANAR && i == 2);
    const double way = turns ? wrapped(to[i] - from[i]) : to[i] - from[i];
    state[i] = from[i] + t * way;
    if (turns) state[i] = wrapped(state[i]);
  }
  if (type_ == FLOATING) {
    const Eigen::Quaterniond q = rotation(from).slerp(t, rotation(to));
    std::copy(q.coeffs().data(), q.coeffs().data() + 4, state + 3);
  }
}

Eigen::Isometry3d JointModel::computeTransform(const double* values) const {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  switch (type_) {
    case REVOLUTE: result.linear() = Eigen::AngleAxisd(values[0], axis_).toRotationMatrix(); break;
    case PRISMATIC: result.translation() = values[0] * axis_; break;
    case PLANAR:
      result.linear() = Eigen::AngleAxisd(values[2], Eigen::Vector3d::UnitZ()).toRotationMatrix();
      result.translation() = Eigen::Vector3d(values[0], values[1], 0.0);
      break;
    case FLOATING:
      result.linear() = rotation(values).normalized().toRotationMatrix();
      result.translation() = Eigen::Map<const Eigen::Vector3d>(values);
      break;
    default: break;
  }
  return result;
}

std::ostream& operator<<(std::ostream& out, const VariableBounds& bounds) {
  const auto range = [&out](const char* name, bool is_bounded, double low, double high) {
    out << name << '.' << (is_bounded ? "bounded" : "unbounded") << " [" << low << ", " << high << "]; ";
  };
  range("P", bounds.position_bounded_, bounds.min_position_, bounds.max_position_);
  range("V", bounds.velocity_bounded_, bounds.min_velocity_, bounds.max_velocity_);
  range("A", bounds.acceleration_bounded_, bounds.min_acceleration_, bounds.max_acceleration_);
  return out;
}

}  // namespace core
}  // namespace moveit
