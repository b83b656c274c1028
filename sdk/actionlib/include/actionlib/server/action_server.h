#pragma once

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/ros.h>
#include <boost/thread.hpp>

#include <list>
#include <mutex>
#include <string>

#include "actionlib/server/server_goal_handle.h"

namespace actionlib {

/** Server of an action that may work on many goals at the same time; the program decides on each by its handle. */
template <class ActionSpec>
class ActionServer {
 public:
  ACTION_DEFINITION(ActionSpec)
  typedef ServerGoalHandle<ActionSpec> GoalHandle;
  typedef boost::function<void(GoalHandle)> Callback;

  ActionServer(ros::NodeHandle n, const std::string& name, Callback goal_cb, Callback cancel_cb, bool auto_start = true)
      : state_(boost::make_shared<State>(ros::NodeHandle(n, name), goal_cb, cancel_cb)) {
    if (auto_start) start();
  }
  ActionServer(ros::NodeHandle n, const std::string& name, Callback goal_cb, bool auto_start = true)
      : ActionServer(n, name, goal_cb, Callback(), auto_start) {}
  ActionServer(ros::NodeHandle n, const std::string& name, bool auto_start = true)
      : ActionServer(n, name, Callback(), Callback(), auto_start) {}
  ActionServer(const ActionServer&) = delete;
  ActionServer& operator=(const ActionServer&) = delete;
  ~ActionServer() { state_->stop(); }

  void registerGoalCallback(Callback callback) { state_->goal_cb = callback; }
  void registerCancelCallback(Callback callback) { state_->cancel_cb = callback; }
  void start() { state_->start(); }

 private:
  typedef typename GoalHandle::Tracked Tracked;
  /** What handles share with the server; they may outlive it. */
  struct State : GoalHandle::Server, boost::enable_shared_from_this<State> {
    State(const ros::NodeHandle& node_, const Callback& goal, const Callback& cancel)
        : node(node_), goal_cb(goal), cancel_cb(cancel) {}

    void start() {
      if (results) return;
      const double frequency = node.param("status_frequency", 5.0);
      results = node.template advertise<ActionResult>("result", 50);
      feedback = node.template advertise<ActionFeedback>("feedback", 50);
      statuses = node.template advertise<actionlib_msgs::GoalStatusArray>("status", 50, true);
      goals_in = node.subscribe("goal", 50, &State::onGoal, this);
      cancels_in = node.subscribe("cancel", 50, &State::onCancel, this);
      if (frequency > 0.0)
        timer = node.createTimer(ros::Duration(1.0 / frequency), [this](const ros::TimerEvent&) { publishStatus(); });
      publishStatus();
    }
    void stop() {
      timer.stop();
      goals_in.shutdown();
      cancels_in.shutdown();
    }

    void onGoal(const ActionGoalConstPtr& message) {
      boost::shared_ptr<Tracked> goal;
      {
        const std::lock_guard<std::recursive_mutex> lock(this->mutex);
        for (const auto& known : goals)
          if (known->status.goal_id.id == message->goal_id.id) {
            // It was canceled before it came.
            if (known->message || known->status.status != actionlib_msgs::GoalStatus::RECALLING) return;
            goal = known;
          }
        const bool is_canceled = static_cast<bool>(goal);
        if (!goal) {
          goal = boost::make_shared<Tracked>();
          goals.push_back(goal);
          goal->status.goal_id = message->goal_id;
        }
        goal->message = message;
        if (goal->status.goal_id.id.empty()) goal->status.goal_id = generateGoalId();
        if (goal->status.goal_id.stamp.isZero()) goal->status.goal_id.stamp = ros::Time::now();
        goal->status.status = actionlib_msgs::GoalStatus::PENDING;
        if (is_canceled || (!last_cancel.isZero() && goal->status.goal_id.stamp <= last_cancel)) {
          GoalHandle(this->shared_from_this(), goal).setCanceled(Result(), "It was canceled before it came");
          return;
        }
        publishStatus();
      }
      if (goal_cb) goal_cb(GoalHandle(this->shared_from_this(), goal));
    }

    void onCancel(const actionlib_msgs::GoalIDConstPtr& id) {
      std::list<boost::shared_ptr<Tracked> > canceled;
      {
        const std::lock_guard<std::recursive_mutex> lock(this->mutex);
        bool is_known = false;
        for (const auto& goal : goals) {
          const bool is_all = id->id.empty() && id->stamp.isZero();
          const bool is_before = !id->stamp.isZero() && goal->status.goal_id.stamp <= id->stamp;
          is_known = is_known || goal->status.goal_id.id == id->id;
          if ((is_all || is_before || goal->status.goal_id.id == id->id) && goal->requestCancel())
            canceled.push_back(goal);
        }
        if (!id->id.empty() && !is_known) {
          const auto early = boost::make_shared<Tracked>();
          early->status.goal_id = *id;
          early->status.status = actionlib_msgs::GoalStatus::RECALLING;
          early->finished = ros::Time::now();
          goals.push_back(early);
        }
        if (id->stamp > last_cancel) last_cancel = id->stamp;
        publishStatus();
      }
      for (const auto& goal : canceled)
        if (cancel_cb) cancel_cb(GoalHandle(this->shared_from_this(), goal));
    }

    void publishResult(const actionlib_msgs::GoalStatus& status, const Result& result) override {
      ActionResult message;
      message.header.stamp = ros::Time::now();
      message.status = status;
      message.result = result;
      results.publish(message);
      publishStatus();
    }
    void publishFeedback(const actionlib_msgs::GoalStatus& status, const Feedback& value) override {
      ActionFeedback message;
      message.header.stamp = ros::Time::now();
      message.status = status;
      message.feedback = value;
      feedback.publish(message);
    }
    void publishStatus() override {
      const std::lock_guard<std::recursive_mutex> lock(this->mutex);
      actionlib_msgs::GoalStatusArray message;
      message.header.stamp = ros::Time::now();
      const double kept = 5.0;  // [s] after its end
      goals.remove_if([&](const boost::shared_ptr<Tracked>& goal) {
        return !goal->finished.isZero() && message.header.stamp.toSec() - goal->finished.toSec() > kept;
      });
      for (const auto& goal : goals) message.status_list.push_back(goal->status);
      statuses.publish(message);
    }

    ros::NodeHandle node;
    Callback goal_cb, cancel_cb;
    ros::Publisher results, feedback, statuses;
    ros::Subscriber goals_in, cancels_in;
    ros::Timer timer;
    std::list<boost::shared_ptr<Tracked> > goals;
    ros::Time last_cancel;
  };

  boost::shared_ptr<State> state_;
};

}  // namespace actionlib
