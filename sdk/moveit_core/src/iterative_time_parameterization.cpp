#include "moveit/trajectory_processing/iterative_time_parameterization.h"

#include <ros/console.h>

#include <algorithm>
#include <cmath>

namespace trajectory_processing {
namespace {

using moveit::core::JointModel;
using moveit::core::RobotState;
using moveit::core::VariableBounds;

constexpr double kDefaultLimit = 1.0;      // [rad/s] and [rad/s²], or [m]
constexpr double kShortestSegment = 1e-4;  // [s]

double usedFactor(double factor) { return factor > 0.0 && factor <= 1.0 ? factor : 1.0; }

/** Positions of one variable, with its limits. */
struct Variable {
  std::size_t index;
  double max_velocity, max_acceleration;
  std::vector<double> positions;
};

std::vector<Variable> variablesOf(const robot_trajectory::RobotTrajectory& trajectory, double velocity_factor,
                                  double acceleration_factor) {
  std::vector<Variable> result;
  for (const JointModel* joint : trajectory.getGroup()->getActiveJointModels()) {
    for (std::size_t i = 0; i < joint->getVariableCount(); ++i) {
      const VariableBounds& bounds = joint->getVariableBounds()[i];
      const double velocity = std::min(std::abs(bounds.max_velocity_), std::abs(bounds.min_velocity_));
      const double acceleration = std::min(std::abs(bounds.max_acceleration_), std::abs(bounds.min_acceleration_));
      Variable variable{
          joint->getFirstVariableIndex() + i,
          velocity_factor * (bounds.velocity_bounded_ && velocity > 0.0 ? velocity : kDefaultLimit),
          acceleration_factor * (bounds.acceleration_bounded_ && acceleration > 0.0 ? acceleration : kDefaultLimit),
          {}};
      for (std::size_t k = 0; k < trajectory.size(); ++k)
        variable.positions.push_back(trajectory.getWayPoint(k).getVariablePositions()[variable.index]);
      result.push_back(variable);
    }
  }
  return result;
}

/** Acceleration at a state that is reached after `before` and left for `after` seconds; at the ends the robot rests. */
double acceleration(const Variable& variable, const std::vector<double>& times, std::size_t i) {
  const auto velocity = [&](std::size_t segment) {
    return (variable.positions[segment + 1] - variable.positions[segment]) / times[segment];
  };
  const double before = i == 0 ? 0.0 : velocity(i - 1);
  const double after = i == times.size() ? 0.0 : velocity(i);
  const double span = (i == 0 ? 0.0 : times[i - 1]) + (i == times.size() ? 0.0 : times[i]);
  return 2.0 * (after - before) / span;
}

double largestRatio(const std::vector<Variable>& variables, const std::vector<double>& times, std::size_t i) {
  double result = 0.0;
  for (const Variable& variable : variables)
    result = std::max(result, std::abs(acceleration(variable, times, i)) / variable.max_acceleration);
  return result;
}

}  // namespace

bool IterativeParabolicTimeParameterization::computeTimeStamps(robot_trajectory::RobotTrajectory& trajectory,
                                                               double max_velocity_scaling_factor,
                                                               double max_acceleration_scaling_factor) const {
  if (trajectory.getGroup() == nullptr) {
    ROS_ERROR_NAMED("trajectory_processing",
                    "It looks like the planner did not set the group the plan was computed for");
    return false;
  }
  if (trajectory.size() < 2) {
    if (!trajectory.empty()) trajectory.setWayPointDurationFromPrevious(0, 0.0);
    return true;
  }
  trajectory.unwind();
  const std::vector<Variable> variables =
      variablesOf(trajectory, usedFactor(max_velocity_scaling_factor), usedFactor(max_acceleration_scaling_factor));
  std::vector<double> times(trajectory.size() - 1, kShortestSegment);
  for (const Variable& variable : variables) {
    for (std::size_t i = 0; i < times.size(); ++i) {
      times[i] =
          std::max(times[i], std::abs(variable.positions[i + 1] - variable.positions[i]) / variable.max_velocity);
    }
  }
  bool is_changed = true;
  for (unsigned int round = 0; round < max_iterations_ && is_changed; ++round) {
    is_changed = false;
    for (std::size_t i = 0; i <= times.size(); ++i) {
      const double ratio = largestRatio(variables, times, i);
      if (ratio <= 1.0) continue;
      is_changed = true;
      const double stretch = std::min(std::sqrt(ratio), 1.0 + 50.0 * max_time_change_per_it_);
      if (i > 0) times[i - 1] *= stretch;
      if (i < times.size()) times[i] *= stretch;
    }
  }
  double rest = 1.0;  // what the rounds did not reach
  for (std::size_t i = 0; i <= times.size(); ++i) rest = std::max(rest, largestRatio(variables, times, i));
  for (double& time : times) time *= std::sqrt(rest);

  trajectory.setWayPointDurationFromPrevious(0, 0.0);
  for (std::size_t i = 0; i < times.size(); ++i) trajectory.setWayPointDurationFromPrevious(i + 1, times[i]);
  for (std::size_t i = 0; i <= times.size(); ++i) {
    RobotState& state = *trajectory.getWayPointPtr(i);
    for (const Variable& variable : variables) {
      double velocity = 0.0;
      if (i > 0 && i < times.size())
        velocity = (variable.positions[i + 1] - variable.positions[i - 1]) / (times[i - 1] + times[i]);
      state.getVariableVelocities()[variable.index] = velocity;
      state.getVariableAccelerations()[variable.index] = acceleration(variable, times, i);
    }
  }
  return true;
}

}  // namespace trajectory_processing
