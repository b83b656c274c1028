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

Stepped step_each(const mjModel* m, mjData* d, int count, const EachStep& each) {
  SleepKey key;
  LawTables laws;
  if (!LawTables::find(m, laws)) throw std::runtime_error("this model has no laws");
  for (int step = 0; step < count; ++step) {
    const std::int64_t time_ns = each.time_ns + step * each.step_ns;
    bool goes_on = true, is_stale = false;
    if (step > 0 || each.acts_first)
      for (StepAction* action : each.actions) goes_on &= action->act(time_ns, each.step_ns);
    if (step > 0 && !key.empty() && each.actions.empty() && all_sleep(m, d)) {
      d->time += m->opt.timestep;  // nothing else would change
    } else {
      guarded_step(m, d);
      if (!each.actions.empty() && !(m->opt.disableflags & mjDSBL_ACTUATION)) report_efforts(laws, m, d);
      if (!each.recorders.empty()) key = sleep_key(m, d);
    }
    for (ContactRecorder* recorder : each.recorders) {
      recorder->record(m, d, time_ns + each.step_ns, key);
      is_stale |= recorder->is_stale();
    }
    if (is_stale || !goes_on) return {step + 1, goes_on};
  }
  return {count, true};
}

}  // namespace trundle
