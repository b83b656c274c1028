#pragma once

#include <tf2/LinearMath/Matrix3x3.h>

namespace tf {
using tf2::Matrix3x3;
}
