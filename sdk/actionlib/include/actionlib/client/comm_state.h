#pragma once

#include <ros/console.h>
#include <string>

namespace actionlib {

/** What a client knows of its goal's way to the server and back. */
class CommState {
 public:
  enum StateEnum {
    WAITING_FOR_GOAL_ACK,
    PENDING,
    ACTIVE,
    WAITING_FOR_RESULT,
    WAITING_FOR_CANCEL_ACK,
    RECALLING,
    PREEMPTING,
    DONE
  };
  StateEnum state_;

  CommState(const StateEnum& state) : state_(state) {}
  bool operator==(const CommState& o) const { return state_ == o.state_; }
  bool operator==(const StateEnum& state) const { return state_ == state; }
  bool operator!=(const CommState& o) const { return state_ != o.state_; }
  bool operator!=(const StateEnum& state) const { return state_ != state; }
  std::string toString() const {
    static const char* const names[] = {"WAITING_FOR_GOAL_ACK",   "PENDING",   "ACTIVE",     "WAITING_FOR_RESULT",
                                        "WAITING_FOR_CANCEL_ACK", "RECALLING", "PREEMPTING", "DONE"};
    return names[state_];
  }
};

}  // namespace actionlib
