#pragma once

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/ros.h>

#include <list>
#include <mutex>
#include <vector>

#include "actionlib/action_definition.h"
#include "actionlib/client/comm_state.h"
#include "actionlib/client/terminal_state.h"

namespace actionlib {

/** Handle of a goal at its client; the goal is followed as long as a handle exists. */
template <class ActionSpec>
class ClientGoalHandle {
 public:
  ACTION_DEFINITION(ActionSpec)
  typedef boost::function<void(ClientGoalHandle)> TransitionCallback;
  typedef boost::function<void(ClientGoalHandle, const FeedbackConstPtr&)> FeedbackCallback;

  ClientGoalHandle() {}

  /** Stop to follow the goal. */
  void reset() { goal_.reset(); }
  bool isExpired() const { return !goal_; }
  CommState getCommState() const {
    if (!goal_) return CommState::DONE;
    const std::lock_guard<std::recursive_mutex> lock(goal_->mutex);
    return goal_->state;
  }
  TerminalState getTerminalState() const {
    if (!goal_) return TerminalState::LOST;
    const std::lock_guard<std::recursive_mutex> lock(goal_->mutex);
    SimpleClientGoalState::StateEnum state;
    if (goal_->state != CommState::DONE || !terminalState(goal_->status.status, state)) return TerminalState::LOST;
    return TerminalState(static_cast<TerminalState::StateEnum>(state - SimpleClientGoalState::RECALLED),
                         goal_->status.text);
  }
  /** Result; null before there is one. */
  ResultConstPtr getResult() const {
    if (!goal_) return ResultConstPtr();
    const std::lock_guard<std::recursive_mutex> lock(goal_->mutex);
    return goal_->result ? ResultConstPtr(goal_->result, &goal_->result->result) : ResultConstPtr();
  }
  void resend() {
    if (goal_) goal_->goals.publish(goal_->message);
  }
  void cancel() {
    if (!goal_) return;
    actionlib_msgs::GoalID id;
    id.id = goal_->message.goal_id.id;
    goal_->cancels.publish(id);
    move(CommState::WAITING_FOR_CANCEL_ACK);
  }
  bool operator==(const ClientGoalHandle& other) const { return goal_ == other.goal_; }
  bool operator!=(const ClientGoalHandle& other) const { return goal_ != other.goal_; }

 private:
  template <class>
  friend class ActionClient;
  typedef actionlib_msgs::GoalStatus Status;

  struct Tracked {
    std::recursive_mutex mutex;
    ActionGoal message;
    TransitionCallback transition_cb;
    FeedbackCallback feedback_cb;
    ros::Publisher goals, cancels;
    CommState state = CommState::WAITING_FOR_GOAL_ACK;
    Status status;
    ActionResultConstPtr result;
  };

  explicit ClientGoalHandle(const boost::shared_ptr<Tracked>& goal) : goal_(goal) {}

  /** States that a goal passes on its way to a status, the last one included. */
  static std::vector<CommState::StateEnum> wayTo(uint8_t status) {
    switch (status) {
      case Status::PENDING: return {CommState::PENDING};
      case Status::ACTIVE: return {CommState::PENDING, CommState::ACTIVE};
      case Status::REJECTED: return {CommState::PENDING, CommState::WAITING_FOR_RESULT};
      case Status::RECALLING: return {CommState::PENDING, CommState::RECALLING};
      case Status::RECALLED: return {CommState::PENDING, CommState::WAITING_FOR_RESULT};
      case Status::PREEMPTING: return {CommState::ACTIVE, CommState::PREEMPTING};
      case Status::PREEMPTED: return {CommState::ACTIVE, CommState::PREEMPTING, CommState::WAITING_FOR_RESULT};
      case Status::SUCCEEDED:
      case Status::ABORTED: return {CommState::PENDING, CommState::ACTIVE, CommState::WAITING_FOR_RESULT};
      default: return {};
    }
  }
  /** How far on the way a state is. */
  static int rank(CommState::StateEnum state) {
    switch (state) {
      case CommState::WAITING_FOR_GOAL_ACK: return 0;
      case CommState::PENDING: return 1;
      case CommState::ACTIVE: return 2;
      case CommState::WAITING_FOR_CANCEL_ACK: return 3;
      case CommState::RECALLING:
      case CommState::PREEMPTING: return 4;
      case CommState::WAITING_FOR_RESULT: return 5;
      default: return 6;
    }
  }
  /** Go on to a state, and call back; nothing happens if the goal is there, or farther. */
  void move(CommState::StateEnum state) {
    {
      const std::lock_guard<std::recursive_mutex> lock(goal_->mutex);
      if (rank(state) <= rank(goal_->state.state_)) return;
      goal_->state = state;
    }
    if (goal_->transition_cb) goal_->transition_cb(*this);
  }
  void onStatus(const Status& status) {
    {
      const std::lock_guard<std::recursive_mutex> lock(goal_->mutex);
      if (goal_->state == CommState::DONE) return;
      goal_->status = status;
    }
    for (const CommState::StateEnum state : wayTo(status.status)) move(state);
  }
  void onResult(const ActionResultConstPtr& result) {
    onStatus(result->status);
    {
      const std::lock_guard<std::recursive_mutex> lock(goal_->mutex);
      if (goal_->state == CommState::DONE) return;
      goal_->result = result;
    }
    move(CommState::DONE);
  }
  void onLost() {
    {
      const std::lock_guard<std::recursive_mutex> lock(goal_->mutex);
      if (rank(goal_->state.state_) == 0 || rank(goal_->state.state_) >= rank(CommState::WAITING_FOR_RESULT)) return;
      goal_->status.status = Status::LOST;
    }
    move(CommState::DONE);
  }

  boost::shared_ptr<Tracked> goal_;
};

}  // namespace actionlib
