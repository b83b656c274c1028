#pragma once

#include <ros/console.h>
#include <string>

namespace actionlib {

/** State of a goal as its client knows it. */
class SimpleClientGoalState {
 public:
  enum StateEnum { PENDING, ACTIVE, RECALLED, REJECTED, PREEMPTED, ABORTED, SUCCEEDED, LOST };
  StateEnum state_;
  std::string text_;

  SimpleClientGoalState(const StateEnum& state, const std::string& text = std::string()) : state_(state), text_(text) {}
  bool operator==(const SimpleClientGoalState& o) const { return state_ == o.state_; }
  bool operator==(const StateEnum& state) const { return state_ == state; }
  bool operator!=(const SimpleClientGoalState& o) const { return state_ != o.state_; }
  bool operator!=(const StateEnum& state) const { return state_ != state; }
  bool isDone() const { return state_ != PENDING && state_ != ACTIVE; }
  std::string getText() const { return text_; }
  std::string toString() const;
};

/** State for a terminal status of actionlib_msgs/GoalStatus; false for any other status. */
bool terminalState(int status, SimpleClientGoalState::StateEnum& state);

}  // namespace actionlib
