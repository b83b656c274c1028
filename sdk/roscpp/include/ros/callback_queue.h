#pragma once

#include "ros/callback_queue_interface.h"

namespace ros {

/** Queue of calls in the order of their arrival; any thread may run them. */
class CallbackQueue : public CallbackQueueInterface {
 public:
  explicit CallbackQueue(bool enabled = true);
  virtual ~CallbackQueue();

  virtual void addCallback(const CallbackInterfacePtr& callback, uint64_t removal_id = 0);
  virtual void removeByID(uint64_t removal_id);

  enum CallOneResult { Called, TryAgain, Disabled, Empty };
  /** Run the oldest call that is ready; if there is none, wait for it up to a timeout. */
  CallOneResult callOne() { return callOne(ros::WallDuration()); }
  CallOneResult callOne(ros::WallDuration timeout);
  /** Run all calls that are in the queue now; if it is empty, wait for the first call up to a timeout. */
  void callAvailable() { callAvailable(ros::WallDuration()); }
  void callAvailable(ros::WallDuration timeout);
  bool empty() { return isEmpty(); }
  bool isEmpty();
  void clear();
  void enable();
  /** Wake up all waiting threads, and run nothing until enable(). */
  void disable();
  bool isEnabled();

 private:
  CallbackQueue(const CallbackQueue&);
  CallbackQueue& operator=(const CallbackQueue&);
  struct Implementation;
  boost::shared_ptr<Implementation> impl_;
};
typedef boost::shared_ptr<CallbackQueue> CallbackQueuePtr;

}  // namespace ros
