#pragma once

#include <ros/node_handle.h>
#include <ros/timer.h>

#include <actionlib/server/action_server.h>
#include <boost/shared_ptr.hpp>
#include <mutex>
#include <string>

namespace realtime_tools {

/** Goal of an action whose result a real-time thread sets; another one sends it, by `runNonRealtime`. */
template <class Action>
class RealtimeServerGoalHandle {
 public:
  ACTION_DEFINITION(Action);
  typedef actionlib::ServerGoalHandle<Action> GoalHandle;
  typedef boost::shared_ptr<Result> ResultPtr;
  typedef boost::shared_ptr<Feedback> FeedbackPtr;

  explicit RealtimeServerGoalHandle(GoalHandle& gh, const ResultPtr& preallocated_result = ResultPtr(),
                                    const FeedbackPtr& preallocated_feedback = FeedbackPtr())
      : gh_(gh),
        preallocated_result_(preallocated_result ? preallocated_result : ResultPtr(new Result)),
        preallocated_feedback_(preallocated_feedback ? preallocated_feedback : FeedbackPtr(new Feedback)) {}

  void setAborted(ResultConstPtr result = ResultConstPtr()) { end(End::kAborted, result); }
  void setCanceled(ResultConstPtr result = ResultConstPtr()) { end(End::kCanceled, result); }
  void setSucceeded(ResultConstPtr result = ResultConstPtr()) { end(End::kSucceeded, result); }
  void setFeedback(FeedbackConstPtr feedback = FeedbackConstPtr()) {
    const std::lock_guard<std::mutex> lock(mutex_);
    feedback_ = feedback;
  }
  bool valid() { return gh_.getGoal() != nullptr; }
  /** Send what was set. */
  void runNonRealtime(const ros::TimerEvent&) {
    if (!valid()) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    const actionlib_msgs::GoalStatus status = gh_.getGoalStatus();
    const bool is_active =
        status.status == actionlib_msgs::GoalStatus::ACTIVE || status.status == actionlib_msgs::GoalStatus::PREEMPTING;
    const Result& result = result_ ? *result_ : *preallocated_result_;
    if (end_ == End::kAborted && is_active) gh_.setAborted(result);
    else if (end_ == End::kSucceeded && is_active) gh_.setSucceeded(result);
    else if (end_ == End::kCanceled && status.status == actionlib_msgs::GoalStatus::PREEMPTING) gh_.setCanceled(result);
    if (end_ == End::kNone && feedback_) gh_.publishFeedback(*feedback_);
    feedback_.reset();
  }

  GoalHandle gh_;
  ResultPtr preallocated_result_;
  FeedbackPtr preallocated_feedback_;

 private:
  enum class End { kNone, kAborted, kCanceled, kSucceeded };

  void end(End how, const ResultConstPtr& result) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (end_ != End::kNone) return;
    end_ = how;
    result_ = result;
  }

  std::mutex mutex_;
  End end_ = End::kNone;
  ResultConstPtr result_;
  FeedbackConstPtr feedback_;
};

}  // namespace realtime_tools
