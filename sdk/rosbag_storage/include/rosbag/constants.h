#pragma once

#include <string>

namespace rosbag {

/** Extension of bags. */
static const std::string BAG_EXTENSION = ".bag";

}  // namespace rosbag
