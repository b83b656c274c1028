// Steps with what C++ does at each of them: actions before it, recording of contacts after it.
#pragma once

#include <cstdint>
#include <vector>

#include "contact_recorder.h"
#include "step_action.h"

namespace trundle {

struct EachStep {
  std::vector<ContactRecorder*> recorders;
  std::vector<StepAction*> actions;  // in this order
  bool acts_first;                   // before the first step, too
  std::int64_t time_ns;              // before the first step
  std::int64_t step_ns;
};

struct Stepped {
  int count;
  bool goes_on;  // no action needs Python
};

// Step up to `count` times, fewer if a recorder is stale or an action needs Python. Throws std::runtime_error with
// MuJoCo's message where it fails.
Stepped step_each(const mjModel* m, mjData* d, int count, const EachStep& each);

}  // namespace trundle
