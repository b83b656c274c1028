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
#include "nodelet/nodelet_console.h"

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
