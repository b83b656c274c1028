#pragma once

#include <tf2/LinearMath/Transform.h>

namespace tf {
using tf2::Transform;
}
