#pragma once

#include <tf2/LinearMath/Vector3.h>

#include "tf/LinearMath/Scalar.h"

namespace tf {
using tf2::Vector3;
}
