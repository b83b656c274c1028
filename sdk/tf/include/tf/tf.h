#pragma once

#include <string>

#include "tf/exceptions.h"
#include "tf/transform_datatypes.h"

namespace tf {

/** Name of a frame with its prefix, which a leading slash keeps away. */
std::string resolve(const std::string& prefix, const std::string& frame_name);

}  // namespace tf
