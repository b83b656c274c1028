#pragma once

#include <bond/Status.h>
#include <ros/ros.h>

#include <condition_variable>
#include <mutex>
#include <string>

namespace bond {

/** Tells two nodes whether the other one lives, by messages on a topic that both know. */
class Bond {
 public:
  typedef boost::function<void()> Callback;

  /** `id`: the same at both ends. Callbacks run where the node's do, without the bond's lock. */
  Bond(const std::string& topic, const std::string& id, Callback on_broken = Callback(),
       Callback on_formed = Callback());
  ~Bond();
  Bond(const Bond&) = delete;
  Bond& operator=(const Bond&) = delete;

  double getConnectTimeout() const { return connect_timeout_; }
  double getDisconnectTimeout() const { return disconnect_timeout_; }
  double getHeartbeatTimeout() const { return heartbeat_timeout_; }
  double getHeartbeatPeriod() const { return heartbeat_period_; }
  /** Times [s], before start(). */
  void setConnectTimeout(double s) { connect_timeout_ = s; }
  void setDisconnectTimeout(double s) { disconnect_timeout_ = s; }
  void setHeartbeatTimeout(double s) { heartbeat_timeout_ = s; }
  void setHeartbeatPeriod(double s) { heartbeat_period_ = s; }
  void setCallbackQueue(ros::CallbackQueueInterface* queue) { node_.setCallbackQueue(queue); }
  void setFormedCallback(Callback on_formed);
  void setBrokenCallback(Callback on_broken);

  void start();
  /** Wait until both ends live; false at the timeout, or if the bond broke before. Negative times are none. */
  bool waitUntilFormed(ros::Duration timeout) { return waitUntilFormed(ros::WallDuration(timeout.toSec())); }
  bool waitUntilFormed(ros::WallDuration timeout = ros::WallDuration(-1));
  bool waitUntilBroken(ros::Duration timeout) { return waitUntilBroken(ros::WallDuration(timeout.toSec())); }
  bool waitUntilBroken(ros::WallDuration timeout = ros::WallDuration(-1));
  bool isBroken();
  /** Tell the other end that this one ends. */
  void breakBond();
  std::string getTopic() const { return topic_; }
  std::string getId() const { return id_; }
  std::string getInstanceId() const { return instance_id_; }

 private:
  enum State { kWaiting, kFormed, kBreaking, kBroken };
  void onStatus(const bond::StatusConstPtr& status);
  void onTimer();
  void change(std::unique_lock<std::mutex>& lock, State state);
  void publish(bool is_active);
  bool waitFor(ros::WallDuration timeout, const boost::function<bool()>& condition);

  ros::NodeHandle node_;
  std::string topic_, id_, instance_id_, other_id_;
  Callback on_broken_, on_formed_;
  double connect_timeout_, disconnect_timeout_, heartbeat_timeout_, heartbeat_period_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_started_ = false, has_formed_ = false;
  State state_ = kWaiting;
  /** When the other end is given up. */
  ros::SteadyTime deadline_, next_heartbeat_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
  ros::SteadyTimer timer_;
};

}  // namespace bond
