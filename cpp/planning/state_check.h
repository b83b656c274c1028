// Question that a solver asks about a state.
#pragma once

namespace trundle::planning {

// Says which states of a robot are valid; whoever implements it in C++ is asked without the GIL.
class StateCheck {
 public:
  StateCheck() = default;
  StateCheck(const StateCheck&) = delete;
  StateCheck& operator=(const StateCheck&) = delete;
  virtual ~StateCheck() = default;

  // `state` holds all variables of the model.
  virtual bool is_valid(const double* state) = 0;
};

}  // namespace trundle::planning
