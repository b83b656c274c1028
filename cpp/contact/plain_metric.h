// MuJoCo's discrete integrator solves in the metric M + h D + h² K, even without dampers and springs, where the
// metric is just M.
#pragma once

#include "law_tables.h"

namespace trundle {

// Solve this step in M if that is equivalent; saves 1/6 of the step of a brick wall and 1/4 of flying balls.
void use_plain_metric(const mjModel* m, mjData* d);

}  // namespace trundle
