#pragma once

#include <string>

#include "tf/exceptions.h"
#include "tf/transform_datatypes.h"

namespace tf {

/** Name of a frame with the prefix; a name with a leading slash gets no prefix. */
std::string resolve(const std::string& prefix, const std::string& frame_name);

}  // namespace tf
