// Action in C++ before each step, such as a controller that is due at every step.
#pragma once

#include <cstdint>
#include <functional>

namespace trundle {

class StepAction {
 public:
  StepAction() = default;
  StepAction(const StepAction&) = default;
  StepAction& operator=(const StepAction&) = default;
  virtual ~StepAction() = default;

  // Act on the engine's state at a time; return false if Python has to be called after the coming step.
  virtual bool act(std::int64_t time_ns, std::int64_t step_ns) = 0;

  // Return a function that restores the state of `act`, but not the engine's.
  virtual std::function<void()> checkpoint() = 0;
};

}  // namespace trundle
