#pragma once

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/ros.h>
#include <boost/thread/mutex.hpp>

#include <boost/shared_ptr.hpp>
#include <mutex>
#include <string>
#include <vector>

#include "nodelet/exception.h"

#define NODELET_DEBUG(...) ROS_DEBUG_NAMED(getName(), __VA_ARGS__)
#define NODELET_DEBUG_NAMED(name, ...) ROS_DEBUG_NAMED(getSuffixedName(name), __VA_ARGS__)
#define NODELET_DEBUG_ONCE(...) ROS_DEBUG_ONCE_NAMED(getName(), __VA_ARGS__)
#define NODELET_DEBUG_COND(cond, ...) ROS_DEBUG_COND_NAMED(cond, getName(), __VA_ARGS__)
#define NODELET_DEBUG_THROTTLE(rate, ...) ROS_DEBUG_THROTTLE_NAMED(rate, getName(), __VA_ARGS__)
#define NODELET_DEBUG_FILTER(filter, ...) ROS_DEBUG_FILTER_NAMED(filter, getName(), __VA_ARGS__)
#define NODELET_DEBUG_STREAM(args) ROS_DEBUG_STREAM_NAMED(getName(), args)
#define NODELET_DEBUG_STREAM_NAMED(name, args) ROS_DEBUG_STREAM_NAMED(getSuffixedName(name), args)
#define NODELET_DEBUG_STREAM_ONCE(args) ROS_DEBUG_STREAM_ONCE_NAMED(getName(), args)
#define NODELET_DEBUG_STREAM_COND(cond, args) ROS_DEBUG_STREAM_COND_NAMED(cond, getName(), args)
#define NODELET_DEBUG_STREAM_THROTTLE(rate, args) ROS_DEBUG_STREAM_THROTTLE_NAMED(rate, getName(), args)
#define NODELET_DEBUG_STREAM_FILTER(filter, args) ROS_DEBUG_STREAM_FILTER_NAMED(filter, getName(), args)
#define NODELET_INFO(...) ROS_INFO_NAMED(getName(), __VA_ARGS__)
#define NODELET_INFO_NAMED(name, ...) ROS_INFO_NAMED(getSuffixedName(name), __VA_ARGS__)
#define NODELET_INFO_ONCE(...) ROS_INFO_ONCE_NAMED(getName(), __VA_ARGS__)
#define NODELET_INFO_COND(cond, ...) ROS_INFO_COND_NAMED(cond, getName(), __VA_ARGS__)
#define NODELET_INFO_THROTTLE(rate, ...) ROS_INFO_THROTTLE_NAMED(rate, getName(), __VA_ARGS__)
#define NODELET_INFO_FILTER(filter, ...) ROS_INFO_FILTER_NAMED(filter, getName(), __VA_ARGS__)
#define NODELET_INFO_STREAM(args) ROS_INFO_STREAM_NAMED(getName(), args)
#define NODELET_INFO_STREAM_NAMED(name, args) ROS_INFO_STREAM_NAMED(getSuffixedName(name), args)
#define NODELET_INFO_STREAM_ONCE(args) ROS_INFO_STREAM_ONCE_NAMED(getName(), args)
#define NODELET_INFO_STREAM_COND(cond, args) ROS_INFO_STREAM_COND_NAMED(cond, getName(), args)
#define NODELET_INFO_STREAM_THROTTLE(rate, args) ROS_INFO_STREAM_THROTTLE_NAMED(rate, getName(), args)
#define NODELET_INFO_STREAM_FILTER(filter, args) ROS_INFO_STREAM_FILTER_NAMED(filter, getName(), args)
#define NODELET_WARN(...) ROS_WARN_NAMED(getName(), __VA_ARGS__)
#define NODELET_WARN_NAMED(name, ...) ROS_WARN_NAMED(getSuffixedName(name), __VA_ARGS__)
#define NODELET_WARN_ONCE(...) ROS_WARN_ONCE_NAMED(getName(), __VA_ARGS__)
#define NODELET_WARN_COND(cond, ...) ROS_WARN_COND_NAMED(cond, getName(), __VA_ARGS__)
#define NODELET_WARN_THROTTLE(rate, ...) ROS_WARN_THROTTLE_NAMED(rate, getName(), __VA_ARGS__)
#define NODELET_WARN_FILTER(filter, ...) ROS_WARN_FILTER_NAMED(filter, getName(), __VA_ARGS__)
#define NODELET_WARN_STREAM(args) ROS_WARN_STREAM_NAMED(getName(), args)
#define NODELET_WARN_STREAM_NAMED(name, args) ROS_WARN_STREAM_NAMED(getSuffixedName(name), args)
#define NODELET_WARN_STREAM_ONCE(args) ROS_WARN_STREAM_ONCE_NAMED(getName(), args)
#define NODELET_WARN_STREAM_COND(cond, args) ROS_WARN_STREAM_COND_NAMED(cond, getName(), args)
#define NODELET_WARN_STREAM_THROTTLE(rate, args) ROS_WARN_STREAM_THROTTLE_NAMED(rate, getName(), args)
#define NODELET_WARN_STREAM_FILTER(filter, args) ROS_WARN_STREAM_FILTER_NAMED(filter, getName(), args)
#define NODELET_ERROR(...) ROS_ERROR_NAMED(getName(), __VA_ARGS__)
#define NODELET_ERROR_NAMED(name, ...) ROS_ERROR_NAMED(getSuffixedName(name), __VA_ARGS__)
#define NODELET_ERROR_ONCE(...) ROS_ERROR_ONCE_NAMED(getName(), __VA_ARGS__)
#define NODELET_ERROR_COND(cond, ...) ROS_ERROR_COND_NAMED(cond, getName(), __VA_ARGS__)
#define NODELET_ERROR_THROTTLE(rate, ...) ROS_ERROR_THROTTLE_NAMED(rate, getName(), __VA_ARGS__)
#define NODELET_ERROR_FILTER(filter, ...) ROS_ERROR_FILTER_NAMED(filter, getName(), __VA_ARGS__)
#define NODELET_ERROR_STREAM(args) ROS_ERROR_STREAM_NAMED(getName(), args)
#define NODELET_ERROR_STREAM_NAMED(name, args) ROS_ERROR_STREAM_NAMED(getSuffixedName(name), args)
#define NODELET_ERROR_STREAM_ONCE(args) ROS_ERROR_STREAM_ONCE_NAMED(getName(), args)
#define NODELET_ERROR_STREAM_COND(cond, args) ROS_ERROR_STREAM_COND_NAMED(cond, getName(), args)
#define NODELET_ERROR_STREAM_THROTTLE(rate, args) ROS_ERROR_STREAM_THROTTLE_NAMED(rate, getName(), args)
#define NODELET_ERROR_STREAM_FILTER(filter, args) ROS_ERROR_STREAM_FILTER_NAMED(filter, getName(), args)
#define NODELET_FATAL(...) ROS_FATAL_NAMED(getName(), __VA_ARGS__)
#define NODELET_FATAL_NAMED(name, ...) ROS_FATAL_NAMED(getSuffixedName(name), __VA_ARGS__)
#define NODELET_FATAL_ONCE(...) ROS_FATAL_ONCE_NAMED(getName(), __VA_ARGS__)
#define NODELET_FATAL_COND(cond, ...) ROS_FATAL_COND_NAMED(cond, getName(), __VA_ARGS__)
#define NODELET_FATAL_THROTTLE(rate, ...) ROS_FATAL_THROTTLE_NAMED(rate, getName(), __VA_ARGS__)
#define NODELET_FATAL_FILTER(filter, ...) ROS_FATAL_FILTER_NAMED(filter, getName(), __VA_ARGS__)
#define NODELET_FATAL_STREAM(args) ROS_FATAL_STREAM_NAMED(getName(), args)
#define NODELET_FATAL_STREAM_NAMED(name, args) ROS_FATAL_STREAM_NAMED(getSuffixedName(name), args)
#define NODELET_FATAL_STREAM_ONCE(args) ROS_FATAL_STREAM_ONCE_NAMED(getName(), args)
#define NODELET_FATAL_STREAM_COND(cond, args) ROS_FATAL_STREAM_COND_NAMED(cond, getName(), args)
#define NODELET_FATAL_STREAM_THROTTLE(rate, args) ROS_FATAL_STREAM_THROTTLE_NAMED(rate, getName(), args)
#define NODELET_FATAL_STREAM_FILTER(filter, args) ROS_FATAL_STREAM_FILTER_NAMED(filter, getName(), args)

namespace nodelet {

typedef boost::shared_ptr<ros::NodeHandle> NodeHandlePtr;
typedef std::map<std::string, std::string> M_string;
typedef std::vector<std::string> V_string;

/** Base of plugins that share a process, and so pass messages on without copying them. */
class Nodelet {
 public:
  Nodelet();
  virtual ~Nodelet();
  Nodelet(const Nodelet&) = delete;
  Nodelet& operator=(const Nodelet&) = delete;

  /** Name the nodelet, and call onInit(). Without queues, callbacks run in threads of its own. */
  void init(const std::string& name, const M_string& remapping_args, const V_string& my_argv,
            ros::CallbackQueueInterface* st_queue = nullptr, ros::CallbackQueueInterface* mt_queue = nullptr);

 protected:
  const std::string& getName() const { return name_; }
  std::string getSuffixedName(const std::string& suffix) const { return name_ + "." + suffix; }
  const V_string& getMyArgv() const { return my_argv_; }
  /** Handle in the nodelet's namespace; its callbacks run one at a time. */
  ros::NodeHandle& getNodeHandle() const;
  ros::NodeHandle& getPrivateNodeHandle() const;
  /** As above, but several callbacks may run at the same time. */
  ros::NodeHandle& getMTNodeHandle() const;
  ros::NodeHandle& getMTPrivateNodeHandle() const;
  ros::CallbackQueueInterface& getSTCallbackQueue() const;
  ros::CallbackQueueInterface& getMTCallbackQueue() const;

 private:
  virtual void onInit() = 0;
  struct Threads;
  ros::NodeHandle& handle(const char* method, NodeHandlePtr& handle, bool is_private, bool is_parallel) const;

  std::string name_;
  V_string my_argv_;
  M_string remappings_;
  mutable std::mutex mutex_;
  mutable NodeHandlePtr nh_, private_nh_, mt_nh_, mt_private_nh_;
  boost::shared_ptr<Threads> threads_;
};

}  // namespace nodelet
