#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <tf2_ros/buffer.h>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <list>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tf/exceptions.h"
#include "tf/transform_datatypes.h"

namespace tf {

/** Name of a frame with the prefix; a name with a leading slash gets no prefix. */
std::string resolve(const std::string& prefix, const std::string& frame_name);

}  // namespace tf
