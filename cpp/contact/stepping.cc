#include "stepping.h"

#include <algorithm>
#include <stdexcept>

#include "guarded_step.h"
#include "law_tables.h"
#include "velocity_motor.h"

namespace trundle {

namespace {

bool all_sleep(const mjModel* m, const mjData* d) {
  return std::all_of(d->tree_asleep, d->tree_asleep + m->ntree, [](int asleep) { return asleep >= 0; });
}

}  // namespace

Stepped step_with_hooks(const mjModel* m, mjData* d, int count, const StepHooks& hooks) {
  SleepKey key;
  LawTables laws;
  if (!LawTables::find(m, laws)) throw std::runtime_error("this model has no laws");
  for (int step = 0; step < count; ++step) {
    const std::int64_t time_ns = hooks.time_ns + step * hooks.step_ns;
    bool goes_on = true, is_stale = false;
    if (step > 0 || hooks.acts_first)
      for (StepAction* action : hooks.actions) goes_on &= action->act(time_ns, hooks.step_ns);
    if (step > 0 && !key.empty() && hooks.actions.empty() && all_sleep(m, d)) {
      d->time += m->opt.timestep;  // only the time changes
    } else {
      guarded_step(m, d);
      if (!hooks.actions.empty() && !(m->opt.disableflags & mjDSBL_ACTUATION)) report_efforts(laws, m, d);
      if (!hooks.recorders.empty()) key = sleep_key(m, d);
    }
    for (ContactRecorder* recorder : hooks.recorders) {
      recorder->record(m, d, time_ns + hooks.step_ns, key);
      is_stale |= recorder->is_stale();
    }
    if (is_stale || !goes_on) return {step + 1, goes_on};
  }
  return {count, true};
}

}  // namespace trundle
