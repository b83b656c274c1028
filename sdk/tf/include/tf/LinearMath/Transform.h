#pragma once

#include <tf2/LinearMath/Transform.h>

#include "tf/LinearMath/Matrix3x3.h"

namespace tf {
using tf2::Transform;
}
