#pragma once

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <boost/scoped_ptr.hpp>
#include <boost/thread.hpp>

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "actionlib/action_definition.h"
#include "actionlib/client/action_client.h"
#include "actionlib/client/simple_client_goal_state.h"
#include "actionlib/goal_id_generator.h"

namespace actionlib {

/** Client of an action that follows one goal at a time. */
template <class ActionSpec>
class SimpleActionClient {
 public:
  ACTION_DEFINITION(ActionSpec)
  typedef boost::function<void(const SimpleClientGoalState& state, const ResultConstPtr& result)> SimpleDoneCallback;
  typedef boost::function<void()> SimpleActiveCallback;
  typedef boost::function<void(const FeedbackConstPtr& feedback)> SimpleFeedbackCallback;

  /** With `spin_thread`, callbacks run in a thread of the client; otherwise in the threads that spin the node. */
  explicit SimpleActionClient(const std::string& name, bool spin_thread = true) : nh_(name) { start(spin_thread); }
  SimpleActionClient(ros::NodeHandle& n, const std::string& name, bool spin_thread = true) : nh_(n, name) {
    start(spin_thread);
  }
  ~SimpleActionClient() {
    if (spinner_) spinner_->stop();
    status_.shutdown();
    feedback_.shutdown();
    result_.shutdown();
  }

  /** Wait for the server; a timeout of 0 s means no limit. */
  bool waitForServer(const ros::Duration& timeout = ros::Duration(0, 0)) {
    return waitUntil(timeout, [this] { return isServerConnected(); });
  }
  bool isServerConnected() const {
    std::unique_lock<std::mutex> lock(mutex_);
    const bool has_status = has_status_message_;
    lock.unlock();
    return has_status && goal_.getNumSubscribers() > 0 && cancel_.getNumSubscribers() > 0 &&
           feedback_.getNumPublishers() > 0 && result_.getNumPublishers() > 0;
  }

  void sendGoal(const Goal& goal, SimpleDoneCallback done_cb = SimpleDoneCallback(),
                SimpleActiveCallback active_cb = SimpleActiveCallback(),
                SimpleFeedbackCallback feedback_cb = SimpleFeedbackCallback()) {
    ActionGoal message;
    message.header.stamp = ros::Time::now();
    message.goal_id = generateGoalId();
    message.goal = goal;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      id_ = message.goal_id.id;
      state_ = SimpleClientGoalState(SimpleClientGoalState::PENDING);
      must_be_listed_ = false;
      result_message_.reset();
      done_cb_ = done_cb;
      active_cb_ = active_cb;
      feedback_cb_ = feedback_cb;
    }
    goal_.publish(message);
  }
  /** Send a goal and wait for its end; cancel it after the first timeout, and wait again for the second. 0 s means no
   * limit. */
  SimpleClientGoalState sendGoalAndWait(const Goal& goal, const ros::Duration& execute_timeout = ros::Duration(0, 0),
                                        const ros::Duration& preempt_timeout = ros::Duration(0, 0)) {
    sendGoal(goal);
    if (waitForResult(execute_timeout)) return getState();
    cancelGoal();
    waitForResult(preempt_timeout);
    return getState();
  }
  /** Wait for the goal's end, until the callback for it has returned; a timeout of 0 s means no limit. */
  bool waitForResult(const ros::Duration& timeout = ros::Duration(0, 0)) {
    if (id().empty()) {
      ROS_ERROR("Trying to waitForResult() when no goal is running.");
      return false;
    }
    return waitUntil(timeout, [this] {
      const std::lock_guard<std::mutex> lock(mutex_);
      return state_.isDone() && (calling_ == std::thread::id() || calling_ == std::this_thread::get_id());
    });
  }
  ResultConstPtr getResult() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!result_message_) return boost::make_shared<Result>();
    return ResultConstPtr(result_message_, &result_message_->result);
  }
  SimpleClientGoalState getState() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return state_;
  }
  void cancelAllGoals() { cancel_.publish(actionlib_msgs::GoalID()); }
  void cancelGoalsAtAndBeforeTime(const ros::Time& time) {
    actionlib_msgs::GoalID id;
    id.stamp = time;
    cancel_.publish(id);
  }
  void cancelGoal() {
    actionlib_msgs::GoalID goal_id;
    goal_id.id = id();
    if (!goal_id.id.empty()) cancel_.publish(goal_id);
  }
  void stopTrackingGoal() {
    const std::lock_guard<std::mutex> lock(mutex_);
    id_.clear();
    state_ = SimpleClientGoalState(SimpleClientGoalState::LOST);
  }

 private:
  void start(bool spin_thread) {
    if (spin_thread) nh_.setCallbackQueue(&queue_);
    goal_ = nh_.template advertise<ActionGoal>("goal", 10);
    cancel_ = nh_.template advertise<actionlib_msgs::GoalID>("cancel", 10);
    status_ = nh_.subscribe("status", 10, &SimpleActionClient::onStatus, this);
    feedback_ = nh_.subscribe("feedback", 10, &SimpleActionClient::onFeedback, this);
    result_ = nh_.subscribe("result", 10, &SimpleActionClient::onResult, this);
    if (!spin_thread) return;
    spinner_.reset(new ros::AsyncSpinner(1, &queue_));
    spinner_->start();
  }

  std::string id() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return id_;
  }

  template <class Condition>
  static bool waitUntil(const ros::Duration& timeout, const Condition& condition) {
    const ros::Time end = ros::Time::now() + timeout;
    while (ros::ok() && !condition()) {
      if (!timeout.isZero() && ros::Time::now() >= end) return false;
      ros::WallDuration(0.01).sleep();
    }
    return condition();
  }

  void onStatus(const actionlib_msgs::GoalStatusArrayConstPtr& message) {
    SimpleActiveCallback active;
    SimpleDoneCallback lost;
    bool is_lost = false;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      has_status_message_ = true;
      if (id_.empty() || state_.isDone()) return;
      bool is_listed = false;
      for (const actionlib_msgs::GoalStatus& goal : message->status_list) {
        if (goal.goal_id.id != id_) continue;
        is_listed = true;
        SimpleClientGoalState::StateEnum end;
        must_be_listed_ = !terminalState(goal.status, end);
        if (goal.status != actionlib_msgs::GoalStatus::PENDING && goal.status != actionlib_msgs::GoalStatus::RECALLING)
          active = setActive();
      }
      if (!is_listed && must_be_listed_) {  // a new server does not know the goal
        state_ = SimpleClientGoalState(SimpleClientGoalState::LOST);
        lost = done_cb_;
        is_lost = true;
        calling_ = std::this_thread::get_id();
      }
    }
    if (active) active();
    if (is_lost) callDone(lost, getResult());
  }

  /** Call the callback for the goal's end, for which waitForResult waits. */
  void callDone(const SimpleDoneCallback& callback, const ResultConstPtr& result) {
    if (callback) callback(getState(), result);
    const std::lock_guard<std::mutex> lock(mutex_);
    calling_ = std::thread::id();
  }

  /** Make the goal active, and return the callback to call; an empty one if it was active. Needs the mutex. */
  SimpleActiveCallback setActive() {
    if (state_ != SimpleClientGoalState::PENDING) return SimpleActiveCallback();
    state_ = SimpleClientGoalState(SimpleClientGoalState::ACTIVE);
    return active_cb_;
  }

  void onFeedback(const ActionFeedbackConstPtr& message) {
    SimpleFeedbackCallback callback;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (message->status.goal_id.id != id_ || state_.isDone()) return;
      callback = feedback_cb_;
    }
    if (callback) callback(FeedbackConstPtr(message, &message->feedback));
  }

  void onResult(const ActionResultConstPtr& message) {
    SimpleActiveCallback active;
    SimpleDoneCallback done;
    SimpleClientGoalState::StateEnum state = SimpleClientGoalState::LOST;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (message->status.goal_id.id != id_ || state_.isDone() || !terminalState(message->status.status, state)) return;
      if (state != SimpleClientGoalState::REJECTED && state != SimpleClientGoalState::RECALLED) active = setActive();
      result_message_ = message;
      done = done_cb_;
    }
    if (active) active();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      state_ = SimpleClientGoalState(state, message->status.text);
      calling_ = std::this_thread::get_id();
    }
    callDone(done, ResultConstPtr(message, &message->result));
  }

  ros::NodeHandle nh_;
  ros::CallbackQueue queue_;
  boost::shared_ptr<ros::AsyncSpinner> spinner_;
  ros::Publisher goal_, cancel_;
  ros::Subscriber status_, feedback_, result_;
  mutable std::mutex mutex_;
  std::string id_;
  SimpleClientGoalState state_ = SimpleClientGoalState(SimpleClientGoalState::LOST);
  bool has_status_message_ = false;
  /** True if the goal is lost once the server does not list it; its result may come later than that. */
  bool must_be_listed_ = false;
  ActionResultConstPtr result_message_;
  SimpleDoneCallback done_cb_;
  SimpleActiveCallback active_cb_;
  SimpleFeedbackCallback feedback_cb_;
  /** Thread that calls done_cb_ now; none: std::thread::id(). */
  std::thread::id calling_;
};

}  // namespace actionlib
