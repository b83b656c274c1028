// Joints behind ros_control's hardware interfaces with the laws that command them: reads, updates and writes before
// each step.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "contact/step_action.h"
#include "servo_laws.h"

namespace trundle {

// What reads and drives joints in place of the engine; times [ns].
class ServoHardware {
 public:
  ServoHardware() = default;
  ServoHardware(const ServoHardware&) = delete;
  ServoHardware& operator=(const ServoHardware&) = delete;
  virtual ~ServoHardware() = default;

  virtual void read(std::int64_t time_ns, std::int64_t period_ns) = 0;
  virtual void write(std::int64_t time_ns, std::int64_t period_ns) = 0;

  // Return a function after which repeated steps do not reach it again.
  virtual std::function<void()> checkpoint() = 0;
};

class Servo : public StepAction {
 public:
  explicit Servo(std::vector<std::shared_ptr<ServoJoint>> joints) : joints_(std::move(joints)) {}

  // Run these laws from now on.
  void set_laws(std::vector<std::shared_ptr<ServoLaw>> laws) { laws_ = std::move(laws); }

  // Read and write by this hardware, too; null: by the engine alone.
  void set_hardware(std::shared_ptr<ServoHardware> hardware) { hardware_ = std::move(hardware); }

  // Begin a period now; no later one is longer than `longest_ns` plus a step.
  void restart(std::int64_t time_ns) { time_ns_ = time_ns; }

  // Read the joints; return the time since the last read [s], 0 if it was at this time.
  double read(std::int64_t time_ns, std::int64_t step_ns);

  // Run the laws; return false if Python has to be called.
  bool update(double dt);
  void write(double dt);

  bool act(std::int64_t time_ns, std::int64_t step_ns) override;
  std::function<void()> checkpoint() override;

  std::int64_t time_ns() const { return time_ns_; }
  std::int64_t longest_ns = 0;

 private:
  std::vector<std::shared_ptr<ServoJoint>> joints_;
  std::vector<std::shared_ptr<ServoLaw>> laws_;
  std::shared_ptr<ServoHardware> hardware_;
  std::int64_t time_ns_ = 0;  // time of the last read
};

// Holds a joint at a multiple of another's position, by a motor of limited effort.
struct MimicAction : StepAction {
  MimicAction(ServoAxis leader, ServoAxis follower, double multiplier, double offset, double min_error,
              double max_effort, std::int64_t lag_steps)
      : leader(std::move(leader)),
        follower(std::move(follower)),
        multiplier(multiplier),
        offset(offset),
        min_error(min_error),
        max_effort(max_effort),
        lag_steps(lag_steps) {}

  bool act(std::int64_t time_ns, std::int64_t step_ns) override;
  std::function<void()> checkpoint() override {
    return [] {};
  }

  ServoAxis leader, follower;
  double multiplier, offset;
  double min_error;        // [rad or m] smaller errors are ignored
  double max_effort;       // [N·m or N]
  std::int64_t lag_steps;  // in which an error is corrected
};

}  // namespace trundle
