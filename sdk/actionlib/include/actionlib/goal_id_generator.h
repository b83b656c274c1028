#pragma once

#include <actionlib_msgs/GoalID.h>

namespace actionlib {

/** New goal ID: the node's name, a number, and the time. */
actionlib_msgs::GoalID generateGoalId();

}  // namespace actionlib
