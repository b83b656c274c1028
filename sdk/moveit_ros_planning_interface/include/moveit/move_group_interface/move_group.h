#pragma once

#include "moveit/move_group_interface/move_group_interface.h"

namespace moveit {
namespace planning_interface {

/** Name of the class before Kinetic. */
typedef MoveGroupInterface MoveGroup;

}  // namespace planning_interface
}  // namespace moveit

namespace move_group_interface = moveit::planning_interface;
