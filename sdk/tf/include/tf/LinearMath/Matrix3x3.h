#pragma once

#include <tf2/LinearMath/Matrix3x3.h>

#include "tf/LinearMath/Quaternion.h"

namespace tf {
using tf2::Matrix3x3;
}
