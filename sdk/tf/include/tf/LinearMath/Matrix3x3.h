#pragma once

#define TF_MATRIX3x3_H  // by which programs know that it is included

#include <tf2/LinearMath/Matrix3x3.h>

#include "tf/LinearMath/Quaternion.h"

namespace tf {
using tf2::Matrix3x3;
}
