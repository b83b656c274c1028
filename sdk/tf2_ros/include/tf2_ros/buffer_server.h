#pragma once

#include <actionlib/server/action_server.h>
#include <tf2_msgs/LookupTransformAction.h>

#include <list>
#include <mutex>
#include <string>

#include "tf2_ros/buffer.h"

namespace tf2_ros {

/** Answers lookups of transforms by an action; each is tried until its timeout. The buffer must exist as long. */
class BufferServer {
 public:
  BufferServer(const Buffer& buffer, const std::string& ns, bool auto_start = true,
               ros::Duration check_period = ros::Duration(0.01));
  void start() { server_.start(); }

 private:
  typedef actionlib::ActionServer<tf2_msgs::LookupTransformAction> Server;
  typedef Server::GoalHandle GoalHandle;
  struct Pending {
    GoalHandle handle;
    ros::Time end;
  };

  void onGoal(GoalHandle handle);
  void onCancel(GoalHandle handle);
  void check();
  /** Try a lookup; false, as long as it may succeed later. */
  bool answer(GoalHandle& handle, const ros::Time& end);

  const Buffer& buffer_;
  std::mutex mutex_;
  std::list<Pending> pending_;
  Server server_;
  ros::Timer timer_;
};

}  // namespace tf2_ros
