#pragma once

#include <ros/console.h>
#include <string>

#include "actionlib/client/simple_client_goal_state.h"

namespace actionlib {

/** How a goal ended. */
class TerminalState {
 public:
  enum StateEnum { RECALLED, REJECTED, PREEMPTED, ABORTED, SUCCEEDED, LOST };
  StateEnum state_;
  std::string text_;

  TerminalState(const StateEnum& state, const std::string& text = std::string()) : state_(state), text_(text) {}
  bool operator==(const TerminalState& o) const { return state_ == o.state_; }
  bool operator==(const StateEnum& state) const { return state_ == state; }
  bool operator!=(const TerminalState& o) const { return state_ != o.state_; }
  bool operator!=(const StateEnum& state) const { return state_ != state; }
  std::string getText() const { return text_; }
  std::string toString() const {
    static const char* const names[] = {"RECALLED", "REJECTED", "PREEMPTED", "ABORTED", "SUCCEEDED", "LOST"};
    return names[state_];
  }
};

}  // namespace actionlib
