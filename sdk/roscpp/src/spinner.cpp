#include "ros/spinner.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "ros/callback_queue.h"
#include "ros/console.h"
#include "ros/init.h"
#include "ros/node_handle.h"

namespace ros {
namespace {

const WallDuration kSlice(0.1);

CallbackQueue* orGlobal(CallbackQueue* queue) { return queue ? queue : getGlobalCallbackQueue(); }

uint32_t threadCount(uint32_t wanted) { return wanted ? wanted : std::max(1U, std::thread::hardware_concurrency()); }

/** Who spins a queue: spinners with a single thread exclude others, except for those of the same thread. */
class Spinning {
 public:
  /** Throws std::runtime_error if another spinner excludes this one. */
  Spinning(CallbackQueue* queue, bool is_single) : queue_(queue) {
    const std::thread::id thread = is_single ? std::this_thread::get_id() : std::thread::id();
    {
      const std::lock_guard<std::mutex> lock(mutex());
      const auto entry = spun().emplace(queue, Entry{thread, 0}).first;
      if (entry->second.thread == thread) {
        ++entry->second.count;
        return;
      }
    }
    const std::string fault =
        is_single ? "SingleThreadedSpinner: Attempt to spin a callback queue that another thread spins. Use one "
                    "MultiThreadedSpinner or AsyncSpinner for several threads."
                  : "AsyncSpinner: Attempt to spin a callback queue that a SingleThreadedSpinner spins.";
    ROS_FATAL_STREAM(fault);
    throw std::runtime_error(fault);
  }
  Spinning(const Spinning&) = delete;
  Spinning& operator=(const Spinning&) = delete;
  ~Spinning() {
    const std::lock_guard<std::mutex> lock(mutex());
    const auto entry = spun().find(queue_);
    if (--entry->second.count == 0) spun().erase(entry);
  }

 private:
  struct Entry {
    std::thread::id thread;  // no thread: of spinners with several
    int count;
  };
  static std::mutex& mutex() {
    static std::mutex* const one = new std::mutex;
    return *one;
  }
  static std::map<CallbackQueue*, Entry>& spun() {
    static auto* const all = new std::map<CallbackQueue*, Entry>;
    return *all;
  }

  CallbackQueue* const queue_;
};

}  // namespace

/** Threads of an AsyncSpinner. */
class AsyncSpinnerImpl {
 public:
  AsyncSpinnerImpl(uint32_t count, CallbackQueue* queue) : count_(threadCount(count)), queue_(orGlobal(queue)) {}
  ~AsyncSpinnerImpl() { stop(); }
  void start() {
    if (!threads_.empty()) return;
    spinning_.reset(new Spinning(queue_, false));
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
    spinning_.reset();
  }

 private:
  uint32_t count_;
  CallbackQueue* queue_;
  std::atomic<bool> goes_on_{false};
  std::vector<std::thread> threads_;
  boost::shared_ptr<NodeHandle> node_;
  std::unique_ptr<Spinning> spinning_;
};

void SingleThreadedSpinner::spin(CallbackQueue* queue) {
  queue = orGlobal(queue);
  const Spinning spinning(queue, true);
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
