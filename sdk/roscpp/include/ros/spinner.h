#pragma once

#include <boost/shared_ptr.hpp>

#include "ros/common.h"
#include "ros/types.h"

namespace ros {

class CallbackQueue;

/** Runs the calls of a queue until the node shuts down. */
class Spinner {
 public:
  virtual ~Spinner() {}
  virtual void spin(CallbackQueue* queue = nullptr) = 0;
};

class SingleThreadedSpinner : public Spinner {
 public:
  virtual void spin(CallbackQueue* queue = nullptr);
};

class MultiThreadedSpinner : public Spinner {
 public:
  /** Create with a number of threads; 0: one for each processor. */
  explicit MultiThreadedSpinner(uint32_t thread_count = 0);
  virtual void spin(CallbackQueue* queue = nullptr);

 private:
  uint32_t thread_count_;
};

class AsyncSpinnerImpl;
typedef boost::shared_ptr<AsyncSpinnerImpl> AsyncSpinnerImplPtr;

/** Runs the calls of a queue in background threads. */
class AsyncSpinner {
 public:
  explicit AsyncSpinner(uint32_t thread_count);
  AsyncSpinner(uint32_t thread_count, CallbackQueue* queue);
  bool canStart();
  void start();
  void stop();

 private:
  AsyncSpinnerImplPtr impl_;
};
typedef boost::shared_ptr<AsyncSpinner> AsyncSpinnerPtr;

}  // namespace ros
