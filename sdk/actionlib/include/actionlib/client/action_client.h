#pragma once

#include <boost/thread.hpp>
#include <map>

#include "actionlib/client/client_goal_handle.h"
#include "actionlib/goal_id_generator.h"

namespace actionlib {

/** Client of an action that may follow many goals at the same time. */
template <class ActionSpec>
class ActionClient {
 public:
  ACTION_DEFINITION(ActionSpec)
  typedef ClientGoalHandle<ActionSpec> GoalHandle;
  typedef typename GoalHandle::TransitionCallback TransitionCallback;
  typedef typename GoalHandle::FeedbackCallback FeedbackCallback;
  typedef boost::function<void(const ActionGoalConstPtr)> SendGoalFunc;

  ActionClient(const std::string& name, ros::CallbackQueueInterface* queue = nullptr)
      : ActionClient(ros::NodeHandle(), name, queue) {}
  ActionClient(const ros::NodeHandle& n, const std::string& name, ros::CallbackQueueInterface* queue = nullptr)
      : node_(n, name) {
    if (queue) node_.setCallbackQueue(queue);
    goals_ = node_.template advertise<ActionGoal>("goal", 10);
    cancels_ = node_.template advertise<actionlib_msgs::GoalID>("cancel", 10);
    status_ = node_.subscribe("status", 10, &ActionClient::onStatus, this);
    feedback_ = node_.subscribe("feedback", 10, &ActionClient::onFeedback, this);
    result_ = node_.subscribe("result", 10, &ActionClient::onResult, this);
  }
  ActionClient(const ActionClient&) = delete;
  ActionClient& operator=(const ActionClient&) = delete;
  ~ActionClient() {
    status_.shutdown();
    feedback_.shutdown();
    result_.shutdown();
  }

  /** Send a goal; it is followed until the last copy of the handle is gone. */
  GoalHandle sendGoal(const Goal& goal, TransitionCallback transition_cb = TransitionCallback(),
                      FeedbackCallback feedback_cb = FeedbackCallback()) {
    const auto tracked = boost::make_shared<Tracked>();
    tracked->message.header.stamp = ros::Time::now();
    tracked->message.goal_id = generateGoalId();
    tracked->message.goal = goal;
    tracked->transition_cb = transition_cb;
    tracked->feedback_cb = feedback_cb;
    tracked->goals = goals_;
    tracked->cancels = cancels_;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      tracked_[tracked->message.goal_id.id] = tracked;
    }
    goals_.publish(tracked->message);
    return GoalHandle(tracked);
  }
  void cancelAllGoals() { cancels_.publish(actionlib_msgs::GoalID()); }
  void cancelGoalsAtAndBeforeTime(const ros::Time& time) {
    actionlib_msgs::GoalID id;
    id.stamp = time;
    cancels_.publish(id);
  }
  /** Wait for the server; a timeout of 0 s is none. */
  bool waitForActionServerToStart(const ros::Duration& timeout = ros::Duration(0, 0)) {
    const double end = ros::Time::now().toSec() + timeout.toSec();
    while (ros::ok() && !isServerConnected()) {
      if (!timeout.isZero() && ros::Time::now().toSec() >= end) return false;
      ros::WallDuration(0.01).sleep();
    }
    return isServerConnected();
  }
  bool isServerConnected() {
    return goals_.getNumSubscribers() > 0 && cancels_.getNumSubscribers() > 0 && status_.getNumPublishers() > 0 &&
           feedback_.getNumPublishers() > 0 && result_.getNumPublishers() > 0;
  }

 private:
  typedef typename GoalHandle::Tracked Tracked;

  GoalHandle find(const std::string& id) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = tracked_.find(id);
    return GoalHandle(found == tracked_.end() ? boost::shared_ptr<Tracked>() : found->second.lock());
  }
  void onStatus(const actionlib_msgs::GoalStatusArrayConstPtr& message) {
    std::map<std::string, actionlib_msgs::GoalStatus> listed;
    for (const actionlib_msgs::GoalStatus& status : message->status_list) listed[status.goal_id.id] = status;
    std::vector<GoalHandle> followed;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (auto entry = tracked_.begin(); entry != tracked_.end();) {
        followed.push_back(GoalHandle(entry->second.lock()));
        entry = followed.back().isExpired() ? tracked_.erase(entry) : std::next(entry);
      }
    }
    for (GoalHandle& handle : followed) {
      if (handle.isExpired()) continue;
      const auto status = listed.find(handle.goal_->message.goal_id.id);
      if (status == listed.end()) handle.onLost();
      else handle.onStatus(status->second);
    }
  }
  void onFeedback(const ActionFeedbackConstPtr& message) {
    GoalHandle handle = find(message->status.goal_id.id);
    if (!handle.isExpired() && handle.goal_->feedback_cb)
      handle.goal_->feedback_cb(handle, FeedbackConstPtr(message, &message->feedback));
  }
  void onResult(const ActionResultConstPtr& message) {
    GoalHandle handle = find(message->status.goal_id.id);
    if (!handle.isExpired()) handle.onResult(message);
  }

  ros::NodeHandle node_;
  ros::Publisher goals_, cancels_;
  ros::Subscriber status_, feedback_, result_;
  std::mutex mutex_;
  std::map<std::string, boost::weak_ptr<Tracked> > tracked_;
};

}  // namespace actionlib
