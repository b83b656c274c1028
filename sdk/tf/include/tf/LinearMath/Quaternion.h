#pragma once

#include <tf2/LinearMath/Quaternion.h>

#include "tf/LinearMath/Vector3.h"

namespace tf {
using tf2::Quaternion;
using tf2::quatRotate;
using tf2::slerp;
}  // namespace tf
