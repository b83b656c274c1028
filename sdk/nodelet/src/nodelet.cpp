#include "nodelet/nodelet.h"

#include <ros/names.h>

namespace nodelet {

/** Queues of a nodelet, and the threads that run them. */
struct Nodelet::Threads {
  ros::CallbackQueue one, many;
  boost::shared_ptr<ros::AsyncSpinner> one_spinner, many_spinner;
  ros::CallbackQueueInterface *st = nullptr, *mt = nullptr;

  ros::CallbackQueueInterface* serial() {
    if (st) return st;
    if (!one_spinner) {
      one_spinner.reset(new ros::AsyncSpinner(1, &one));
      one_spinner->start();
    }
    return &one;
  }
  ros::CallbackQueueInterface* parallel() {
    if (mt) return mt;
    if (!many_spinner) {
      many_spinner.reset(new ros::AsyncSpinner(ros::param::param<int>("~num_worker_threads", 0), &many));
      many_spinner->start();
    }
    return &many;
  }
  void stop() {
    if (one_spinner) one_spinner->stop();
    if (many_spinner) many_spinner->stop();
    one.disable();
    many.disable();
  }
};

Nodelet::Nodelet() : threads_(boost::make_shared<Threads>()) {}

Nodelet::~Nodelet() { threads_->stop(); }

void Nodelet::init(const std::string& name, const M_string& remapping_args, const V_string& my_argv,
                   ros::CallbackQueueInterface* st_queue, ros::CallbackQueueInterface* mt_queue) {
  if (!name_.empty()) throw MultipleInitializationException();
  name_ = name;
  remappings_ = remapping_args;
  my_argv_ = my_argv;
  threads_->st = st_queue;
  threads_->mt = mt_queue;
  onInit();
}

ros::NodeHandle& Nodelet::handle(const char* method, NodeHandlePtr& handle, bool is_private, bool is_parallel) const {
  if (name_.empty()) throw UninitializedException(method);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!handle) {
    handle.reset(new ros::NodeHandle(is_private ? name_ : ros::names::parentNamespace(name_), remappings_));
    handle->setCallbackQueue(is_parallel ? threads_->parallel() : threads_->serial());
  }
  return *handle;
}

ros::NodeHandle& Nodelet::getNodeHandle() const { return handle("getNodeHandle", nh_, false, false); }
ros::NodeHandle& Nodelet::getPrivateNodeHandle() const {
  return handle("getPrivateNodeHandle", private_nh_, true, false);
}
ros::NodeHandle& Nodelet::getMTNodeHandle() const { return handle("getMTNodeHandle", mt_nh_, false, true); }
ros::NodeHandle& Nodelet::getMTPrivateNodeHandle() const {
  return handle("getMTPrivateNodeHandle", mt_private_nh_, true, true);
}
ros::CallbackQueueInterface& Nodelet::getSTCallbackQueue() const { return *getNodeHandle().getCallbackQueue(); }
ros::CallbackQueueInterface& Nodelet::getMTCallbackQueue() const { return *getMTNodeHandle().getCallbackQueue(); }

}  // namespace nodelet
