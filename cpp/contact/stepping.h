// Steps with hooks: actions before each step, recording of contacts after it.
#pragma once

#include <cstdint>
#include <vector>

#include "contact_recorder.h"
#include "step_action.h"

namespace trundle {

struct StepHooks {
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
// MuJoCo's message on an error.
Stepped step_with_hooks(const mjModel* m, mjData* d, int count, const StepHooks& hooks);

}  // namespace trundle
