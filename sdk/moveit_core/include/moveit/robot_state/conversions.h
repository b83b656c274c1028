#pragma once

#include <moveit_msgs/RobotState.h>
#include <sensor_msgs/JointState.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <iosfwd>
#include <string>
#include <vector>

#include "moveit/robot_state/robot_state.h"

namespace moveit {
namespace core {

/** Set a state's variables that a message names; false, with an error, if it is invalid. */
bool jointStateToRobotState(const sensor_msgs::JointState& joint_state, RobotState& state);
bool robotStateMsgToRobotState(const moveit_msgs::RobotState& robot_state, RobotState& state,
                               bool copy_attached_bodies = true);
void robotStateToRobotStateMsg(const RobotState& state, moveit_msgs::RobotState& robot_state,
                               bool copy_attached_bodies = true);
/** Joints with one variable, as they are published. */
void robotStateToJointStateMsg(const RobotState& state, sensor_msgs::JointState& joint_state);
bool jointTrajPointToRobotState(const trajectory_msgs::JointTrajectory& trajectory, std::size_t point_id,
                                RobotState& state);
/** One line of positions; with a header, one of names before it. */
void robotStateToStream(const RobotState& state, std::ostream& out, bool include_header = true,
                        const std::string& separator = ",");

}  // namespace core
}  // namespace moveit
