#pragma once

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatus.h>
#include <ros/ros.h>

#include <boost/enable_shared_from_this.hpp>
#include <mutex>
#include <string>

#include "actionlib/action_definition.h"
#include "actionlib/enclosure_deleter.h"
#include "actionlib/goal_id_generator.h"

namespace actionlib {

/** Handle of a goal at its server, by which the program accepts and finishes it. */
template <class ActionSpec>
class ServerGoalHandle {
 public:
  ACTION_DEFINITION(ActionSpec)

  ServerGoalHandle() {}

  /** Begin to work on a goal that is pending. */
  void setAccepted(const std::string& text = std::string("")) {
    change("setAccepted", text, [](uint8_t status) -> int {
      if (status == Status::PENDING) return Status::ACTIVE;
      return status == Status::RECALLING ? Status::PREEMPTING : -1;
    });
  }
  void setCanceled(const Result& result = Result(), const std::string& text = std::string("")) {
    finish("setCanceled", result, text, [](uint8_t status) -> int {
      if (status == Status::PENDING || status == Status::RECALLING) return Status::RECALLED;
      return status == Status::ACTIVE || status == Status::PREEMPTING ? Status::PREEMPTED : -1;
    });
  }
  void setRejected(const Result& result = Result(), const std::string& text = std::string("")) {
    finish("setRejected", result, text, [](uint8_t status) -> int {
      return status == Status::PENDING || status == Status::RECALLING ? Status::REJECTED : -1;
    });
  }
  void setAborted(const Result& result = Result(), const std::string& text = std::string("")) {
    finish("setAborted", result, text, [](uint8_t status) -> int {
      return status == Status::ACTIVE || status == Status::PREEMPTING ? Status::ABORTED : -1;
    });
  }
  void setSucceeded(const Result& result = Result(), const std::string& text = std::string("")) {
    finish("setSucceeded", result, text, [](uint8_t status) -> int {
      return status == Status::ACTIVE || status == Status::PREEMPTING ? Status::SUCCEEDED : -1;
    });
  }
  void publishFeedback(const Feedback& feedback) {
    if (isValid()) server_->publishFeedback(getGoalStatus(), feedback);
  }

  bool isValid() const { return static_cast<bool>(goal_); }
  GoalConstPtr getGoal() const {
    return isValid() && goal_->message ? GoalConstPtr(goal_->message, &goal_->message->goal) : GoalConstPtr();
  }
  actionlib_msgs::GoalID getGoalID() const { return getGoalStatus().goal_id; }
  actionlib_msgs::GoalStatus getGoalStatus() const {
    if (!isValid()) return actionlib_msgs::GoalStatus();
    const std::lock_guard<std::recursive_mutex> lock(server_->mutex);
    return goal_->status;
  }
  bool operator==(const ServerGoalHandle& other) const {
    return (!goal_ && !other.goal_) || (goal_ && other.goal_ && getGoalID().id == other.getGoalID().id);
  }
  bool operator!=(const ServerGoalHandle& other) const { return !(*this == other); }

 private:
  template <class>
  friend class ActionServer;
  typedef actionlib_msgs::GoalStatus Status;

  /** A goal and its status; finished ones stay listed for some seconds. */
  struct Tracked {
    /** True if its status changes, and the program is to be told. */
    bool requestCancel() {
      if (status.status == Status::PENDING) status.status = Status::RECALLING;
      else if (status.status == Status::ACTIVE) status.status = Status::PREEMPTING;
      else return false;
      return true;
    }
    ActionGoalConstPtr message;
    Status status;
    ros::Time finished;
  };
  struct Server {
    virtual ~Server() {}
    virtual void publishResult(const Status& status, const Result& result) = 0;
    virtual void publishFeedback(const Status& status, const Feedback& feedback) = 0;
    virtual void publishStatus() = 0;
    std::recursive_mutex mutex;
  };
  typedef int (*Next)(uint8_t status);

  ServerGoalHandle(const boost::shared_ptr<Server>& server, const boost::shared_ptr<Tracked>& goal)
      : server_(server), goal_(goal) {}

  /** Go to the next status; false, with an error in the log, if there is none. */
  bool move(const char* what, const std::string& text, Next next) {
    if (!isValid()) {
      ROS_ERROR_NAMED("actionlib", "Attempt to call %s on an uninitialized ServerGoalHandle", what);
      return false;
    }
    const int status = next(goal_->status.status);
    if (status < 0) {
      ROS_ERROR_NAMED("actionlib", "%s is not possible for a goal with status %d", what, goal_->status.status);
      return false;
    }
    goal_->status.status = static_cast<uint8_t>(status);
    goal_->status.text = text;
    return true;
  }
  void change(const char* what, const std::string& text, Next next) {
    if (!server_) {
      move(what, text, next);
      return;
    }
    const std::lock_guard<std::recursive_mutex> lock(server_->mutex);
    if (move(what, text, next)) server_->publishStatus();
  }
  void finish(const char* what, const Result& result, const std::string& text, Next next) {
    if (!server_) {
      move(what, text, next);
      return;
    }
    const std::lock_guard<std::recursive_mutex> lock(server_->mutex);
    if (!move(what, text, next)) return;
    goal_->finished = ros::Time::now();
    server_->publishResult(goal_->status, result);
  }

  boost::shared_ptr<Server> server_;
  boost::shared_ptr<Tracked> goal_;
};

}  // namespace actionlib
