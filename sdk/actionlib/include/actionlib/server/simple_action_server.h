#pragma once

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/ros.h>
#include <boost/thread.hpp>

#include <condition_variable>
#include <list>
#include <mutex>
#include <string>
#include <thread>

#include "actionlib/action_definition.h"
#include "actionlib/goal_id_generator.h"
#include "actionlib/server/action_server.h"

namespace actionlib {

/** Server of an action that works on one goal at a time; a newer goal preempts the older. */
template <class ActionSpec>
class SimpleActionServer {
 public:
  ACTION_DEFINITION(ActionSpec)
  typedef boost::function<void(const GoalConstPtr&)> ExecuteCallback;

  /** With a callback, a thread of the server runs it for each goal; without, the program accepts the goals. */
  SimpleActionServer(std::string name, ExecuteCallback execute_callback, bool auto_start = true)
      : nh_(name), execute_(execute_callback) {
    if (auto_start) start();
  }
  explicit SimpleActionServer(std::string name, bool auto_start = true) : nh_(name) {
    if (auto_start) start();
  }
  SimpleActionServer(ros::NodeHandle n, std::string name, ExecuteCallback execute_callback, bool auto_start = true)
      : nh_(n, name), execute_(execute_callback) {
    if (auto_start) start();
  }
  SimpleActionServer(ros::NodeHandle n, std::string name, bool auto_start = true) : nh_(n, name) {
    if (auto_start) start();
  }
  ~SimpleActionServer() { shutdown(); }

  void start() {
    if (result_) return;
    const double frequency = nh_.param("status_frequency", 5.0);
    result_ = nh_.template advertise<ActionResult>("result", 50);
    feedback_ = nh_.template advertise<ActionFeedback>("feedback", 50);
    status_ = nh_.template advertise<actionlib_msgs::GoalStatusArray>("status", 50, true);
    goal_ = nh_.subscribe("goal", 50, &SimpleActionServer::onGoal, this);
    cancel_ = nh_.subscribe("cancel", 50, &SimpleActionServer::onCancel, this);
    if (frequency > 0.0)
      timer_ = nh_.createTimer(ros::Duration(1.0 / frequency), [this](const ros::TimerEvent&) { publishStatus(); });
    publishStatus();
    if (execute_ && !thread_.joinable()) thread_ = std::thread([this] { execute(); });
  }
  void shutdown() {
    {
      const std::lock_guard<std::recursive_mutex> lock(mutex_);
      is_ended_ = true;
      changed_.notify_all();
    }
    timer_.stop();
    goal_.shutdown();
    cancel_.shutdown();
    if (thread_.joinable() && thread_.get_id() != std::this_thread::get_id()) thread_.join();
  }

  /** Make the newest goal the current one, and preempt an older one that is active. Null if there is no new goal. */
  GoalConstPtr acceptNewGoal() {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    if (!next_) {
      ROS_ERROR("Attempting to accept the next goal when a new goal is not available");
      return GoalConstPtr();
    }
    if (isActive()) finish(actionlib_msgs::GoalStatus::PREEMPTED, Result(), kReplaced());
    current_ = next_;
    next_.reset();
    is_preempt_requested_ = is_next_preempted_;
    is_next_preempted_ = false;
    const bool is_recalling = current_->status.status == actionlib_msgs::GoalStatus::RECALLING;
    current_->status.status = actionlib_msgs::GoalStatus::ACTIVE;
    if (is_recalling) current_->status.status = actionlib_msgs::GoalStatus::PREEMPTING;
    current_->status.text = "This goal has been accepted by the simple action server";
    publishStatus();
    return GoalConstPtr(current_->message, &current_->message->goal);
  }
  bool isNewGoalAvailable() {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    return static_cast<bool>(next_);
  }
  bool isPreemptRequested() {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    return is_preempt_requested_;
  }
  bool isActive() {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    return current_ && (current_->status.status == actionlib_msgs::GoalStatus::ACTIVE ||
                        current_->status.status == actionlib_msgs::GoalStatus::PREEMPTING);
  }
  void setSucceeded(const Result& result = Result(), const std::string& text = std::string("")) {
    finish(actionlib_msgs::GoalStatus::SUCCEEDED, result, text);
  }
  void setAborted(const Result& result = Result(), const std::string& text = std::string("")) {
    finish(actionlib_msgs::GoalStatus::ABORTED, result, text);
  }
  void setPreempted(const Result& result = Result(), const std::string& text = std::string("")) {
    finish(actionlib_msgs::GoalStatus::PREEMPTED, result, text);
  }
  void publishFeedback(const FeedbackConstPtr& feedback) { publishFeedback(*feedback); }
  void publishFeedback(const Feedback& feedback) {
    ActionFeedback message;
    {
      const std::lock_guard<std::recursive_mutex> lock(mutex_);
      if (!current_) return;
      message.status = current_->status;
    }
    message.header.stamp = ros::Time::now();
    message.feedback = feedback;
    feedback_.publish(message);
  }
  void registerGoalCallback(boost::function<void()> callback) {
    if (execute_) ROS_WARN("Cannot call SimpleActionServer::registerGoalCallback() because an executeCallback exists.");
    else goal_callback_ = callback;
  }
  void registerPreemptCallback(boost::function<void()> callback) { preempt_callback_ = callback; }

 private:
  /** A goal and its status; a finished goal stays in the status list for some seconds. */
  struct Tracked {
    ActionGoalConstPtr message;
    actionlib_msgs::GoalStatus status;
    ros::Time finished;
  };
  typedef boost::shared_ptr<Tracked> TrackedPtr;
  static const char* kReplaced() {
    return "This goal was canceled because another goal was received by the simple action server";
  }

  void onGoal(const ActionGoalConstPtr& message) {
    boost::function<void()> preempt, arrived;
    {
      const std::lock_guard<std::recursive_mutex> lock(mutex_);
      for (const TrackedPtr& known : goals_)
        if (known->status.goal_id.id == message->goal_id.id) return;
      const TrackedPtr goal = boost::make_shared<Tracked>();
      goal->message = message;
      goal->status.goal_id = message->goal_id;
      if (goal->status.goal_id.id.empty()) goal->status.goal_id = generateGoalId();
      if (goal->status.goal_id.stamp.isZero()) goal->status.goal_id.stamp = ros::Time::now();
      goal->status.status = actionlib_msgs::GoalStatus::PENDING;
      goals_.push_back(goal);
      const ros::Time stamp = goal->status.goal_id.stamp;
      if ((current_ && stamp < current_->status.goal_id.stamp) || (next_ && stamp < next_->status.goal_id.stamp)) {
        finishGoal(goal, actionlib_msgs::GoalStatus::RECALLED, Result(), kReplaced());
        return;
      }
      if (next_) finishGoal(next_, actionlib_msgs::GoalStatus::RECALLED, Result(), kReplaced());
      next_ = goal;
      is_next_preempted_ = false;
      if (isActive()) {
        is_preempt_requested_ = true;
        preempt = preempt_callback_;
      }
      arrived = goal_callback_;
      publishStatus();
      changed_.notify_all();
    }
    if (preempt) preempt();
    if (arrived) arrived();
  }

  void onCancel(const actionlib_msgs::GoalIDConstPtr& id) {
    boost::function<void()> preempt;
    {
      const std::lock_guard<std::recursive_mutex> lock(mutex_);
      for (const TrackedPtr& goal : goals_) {
        const bool is_all = id->id.empty() && id->stamp.isZero();
        const bool is_before = !id->stamp.isZero() && goal->status.goal_id.stamp <= id->stamp;
        if (!is_all && !is_before && goal->status.goal_id.id != id->id) continue;
        if (goal == next_) {
          goal->status.status = actionlib_msgs::GoalStatus::RECALLING;
          is_next_preempted_ = true;
        } else if (goal == current_ && goal->status.status == actionlib_msgs::GoalStatus::ACTIVE) {
          goal->status.status = actionlib_msgs::GoalStatus::PREEMPTING;
          is_preempt_requested_ = true;
          preempt = preempt_callback_;
        }
      }
      publishStatus();
    }
    if (preempt) preempt();
  }

  void finish(uint8_t status, const Result& result, const std::string& text) {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    if (isActive()) finishGoal(current_, status, result, text);
  }

  void finishGoal(const TrackedPtr& goal, uint8_t status, const Result& result, const std::string& text) {
    goal->status.status = status;
    goal->status.text = text;
    goal->finished = ros::Time::now();
    ActionResult message;
    message.header.stamp = goal->finished;
    message.status = goal->status;
    message.result = result;
    result_.publish(message);
    publishStatus();
  }

  void publishStatus() {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    actionlib_msgs::GoalStatusArray message;
    message.header.stamp = ros::Time::now();
    const ros::Duration kept(5.0);
    goals_.remove_if([&](const TrackedPtr& goal) {
      return !goal->finished.isZero() && message.header.stamp - goal->finished > kept;
    });
    for (const TrackedPtr& goal : goals_) message.status_list.push_back(goal->status);
    status_.publish(message);
  }

  void execute() {
    while (true) {
      GoalConstPtr goal;
      {
        std::unique_lock<std::recursive_mutex> lock(mutex_);
        while (!is_ended_ && ros::ok() && !next_) changed_.wait_for(lock, std::chrono::milliseconds(100));
        if (is_ended_ || !ros::ok()) return;
        goal = acceptNewGoal();
      }
      execute_(goal);
      const std::lock_guard<std::recursive_mutex> lock(mutex_);
      if (!isActive()) continue;
      ROS_WARN("Your executeCallback did not set the goal to a terminal status. Fix your ActionServer implementation!");
      setAborted(Result(),
                 "This goal was aborted by the simple action server. The user should have set a terminal "
                 "status on this goal and did not");
    }
  }

  ros::NodeHandle nh_;
  ExecuteCallback execute_;
  boost::function<void()> goal_callback_, preempt_callback_;
  ros::Publisher result_, feedback_, status_;
  ros::Subscriber goal_, cancel_;
  ros::Timer timer_;
  std::recursive_mutex mutex_;
  std::condition_variable_any changed_;
  std::list<TrackedPtr> goals_;
  TrackedPtr current_, next_;
  bool is_preempt_requested_ = false, is_next_preempted_ = false, is_ended_ = false;
  std::thread thread_;
};

}  // namespace actionlib
