#include "ros/spinner.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "ros/callback_queue.h"
#include "ros/init.h"
#include "ros/node_handle.h"

namespace ros {
namespace {

const WallDuration kSlice(0.1);

CallbackQueue* orGlobal(CallbackQueue* queue) { return queue ? queue : getGlobalCallbackQueue(); }

uint32_t threadCount(uint32_t wanted) { return wanted ? wanted : std::max(1U, std::thread::hardware_concurrency()); }

}  // namespace

/** Threads of an AsyncSpinner. */
class AsyncSpinnerImpl {
 public:
  AsyncSpinnerImpl(uint32_t count, CallbackQueue* queue) : count_(threadCount(count)), queue_(orGlobal(queue)) {}
  ~AsyncSpinnerImpl() { stop(); }
  void start() {
    if (!threads_.empty()) return;
    node_.reset(new NodeHandle);
    goes_on_ = true;
    for (uint32_t i = 0; i < count_; ++i)
      threads_.emplace_back([this] {
        while (goes_on_ && ok()) {
          const CallbackQueue::CallOneResult result = queue_->callOne(kSlice);
          if (result == CallbackQueue::Disabled && ok()) kSlice.sleep();
        }
      });
  }
  void stop() {
    goes_on_ = false;
    for (std::thread& thread : threads_)
      if (thread.get_id() == std::this_thread::get_id()) thread.detach();  // a callback stops its own spinner
      else thread.join();
    threads_.clear();
  }

 private:
  uint32_t count_;
  CallbackQueue* queue_;
  std::atomic<bool> goes_on_{false};
  std::vector<std::thread> threads_;
  boost::shared_ptr<NodeHandle> node_;
};

void SingleThreadedSpinner::spin(CallbackQueue* queue) {
  queue = orGlobal(queue);
  const NodeHandle node;
  while (node.ok()) queue->callAvailable(kSlice);
}

MultiThreadedSpinner::MultiThreadedSpinner(uint32_t thread_count) : thread_count_(thread_count) {}

void MultiThreadedSpinner::spin(CallbackQueue* queue) {
  AsyncSpinner spinner(thread_count_, queue);
  spinner.start();
  waitForShutdown();
}

AsyncSpinner::AsyncSpinner(uint32_t thread_count) : AsyncSpinner(thread_count, nullptr) {}
AsyncSpinner::AsyncSpinner(uint32_t thread_count, CallbackQueue* queue)
    : impl_(boost::make_shared<AsyncSpinnerImpl>(thread_count, queue)) {}
bool AsyncSpinner::canStart() { return true; }
void AsyncSpinner::start() { impl_->start(); }
void AsyncSpinner::stop() { impl_->stop(); }

}  // namespace ros
