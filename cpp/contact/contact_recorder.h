// Contacts of chosen geoms, recorded at every step while the engine steps.
//
// MuJoCo keeps no contacts of sleeping bodies: their rows are set by the caller whenever other bodies sleep, and are
// recorded at every step until then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "mujoco_api.h"

namespace trundle {

// Contact as physics/step/contact.py reads it, in world axes.
struct ContactRow {
  double geom[2];
  double position[3], normal[3];  // [m]; from the first geom into the second
  double force[3], torque[3];     // [N, N·m] acting from the first on the second at the position
  double depth;                   // [m]
};

ContactRow read_contact(const mjModel* m, const mjData* d, int contact);

// Sleeping bodies and their poses; empty if no body sleeps.
using SleepKey = std::vector<double>;

SleepKey sleep_key(const mjModel* m, const mjData* d);

struct RecordedStep {
  std::int64_t time_ns = 0;
  std::vector<ContactRow> rows;
};

// Copies are independent.
class ContactRecorder {
 public:
  // geoms: indices; max_steps: number of the latest steps with contacts to keep.
  ContactRecorder(const std::vector<int>& geoms, int geom_count, std::size_t max_steps);

  // Record the contacts of the last step.
  void record(const mjModel* m, const mjData* d, std::int64_t time_ns, const SleepKey& key);

  // True if other bodies sleep than at the last `set_sleeping`, which must be called to complete the last step.
  bool is_stale() const { return stale_; }
  void set_sleeping(std::vector<ContactRow> rows);

  // Replace the rows recorded at that time or later.
  void replace_since(std::int64_t time_ns, std::vector<ContactRow> rows);

  const std::deque<RecordedStep>& steps() const { return steps_; }
  void clear() { steps_.clear(); }

 private:
  bool has(double geom) const { return geoms_[static_cast<std::size_t>(geom)] != 0; }
  void keep(RecordedStep step);

  std::vector<std::uint8_t> geoms_;
  std::size_t max_steps_;
  std::deque<RecordedStep> steps_;
  SleepKey key_;
  std::vector<ContactRow> sleeping_;
  bool stale_ = false;
  RecordedStep waiting_;
};

}  // namespace trundle
