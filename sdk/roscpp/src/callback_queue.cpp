#include "ros/callback_queue.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <set>
#include <thread>

#include "ros/console.h"

namespace ros {

namespace {

/** Longest wait for a removed owner's call: that call may itself wait for whoever removes it. */
constexpr std::chrono::seconds kPatience(5);

/** Queues that were not destroyed. It is never destroyed itself: queues may be static. */
struct Queues {
  std::mutex mutex;
  std::set<const CallbackQueueInterface*> known;
  static Queues& all() {
    static Queues* const queues = new Queues;
    return *queues;
  }
};

}  // namespace

CallbackQueueInterface::CallbackQueueInterface() {
  const std::lock_guard<std::mutex> lock(Queues::all().mutex);
  Queues::all().known.insert(this);
}

CallbackQueueInterface::~CallbackQueueInterface() {
  const std::lock_guard<std::mutex> lock(Queues::all().mutex);
  Queues::all().known.erase(this);
}

bool CallbackQueueInterface::exists(const CallbackQueueInterface* queue) {
  const std::lock_guard<std::mutex> lock(Queues::all().mutex);
  return Queues::all().known.count(queue) > 0;
}

struct CallbackQueue::Implementation {
  struct Entry {
    CallbackInterfacePtr callback;
    uint64_t owner;
  };
  struct RunningCall {
    std::thread::id thread;
    bool is_removed = false;
  };
  std::mutex mutex;
  std::condition_variable changed;
  std::deque<Entry> entries;
  /** Owner → its calls that run. */
  std::multimap<uint64_t, RunningCall> running;
  bool is_enabled = true;

  /** Wait until some call is ready; false at the timeout, or once the queue is disabled. */
  bool waitForReady(std::unique_lock<std::mutex>& lock, const WallDuration& timeout) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::nanoseconds(timeout.toNSec());
    while (is_enabled && firstReady() == entries.end()) {
      if (timeout.isZero()) return false;
      if (changed.wait_until(lock, end) == std::cv_status::timeout) return is_enabled && firstReady() != entries.end();
    }
    return is_enabled;
  }

  std::deque<Entry>::iterator firstReady() {
    return std::find_if(entries.begin(), entries.end(), [](const Entry& entry) { return entry.callback->ready(); });
  }

  CallOneResult run(std::unique_lock<std::mutex>& lock) {
    const auto ready = firstReady();
    if (ready == entries.end()) return entries.empty() ? Empty : CallbackQueue::TryAgain;
    const Entry entry = *ready;
    entries.erase(ready);
    const auto running_call = running.emplace(entry.owner, RunningCall{std::this_thread::get_id()});
    lock.unlock();
    CallbackInterface::CallResult result = CallbackInterface::Invalid;
    const auto finish = [&] {
      lock.lock();
      if (result == CallbackInterface::TryAgain && !running_call->second.is_removed) entries.push_back(entry);
      running.erase(running_call);
      changed.notify_all();
    };
    try {
      result = entry.callback->call();
    } catch (...) {
      finish();
      throw;
    }
    finish();
    return result == CallbackInterface::TryAgain ? CallbackQueue::TryAgain : Called;
  }
};

CallbackQueue::CallbackQueue(bool enabled) : impl_(boost::make_shared<Implementation>()) {
  impl_->is_enabled = enabled;
}

CallbackQueue::~CallbackQueue() { disable(); }

void CallbackQueue::addCallback(const CallbackInterfacePtr& callback, uint64_t removal_id) {
  {
    const std::lock_guard<std::mutex> lock(impl_->mutex);
    if (!impl_->is_enabled) return;
    impl_->entries.push_back({callback, removal_id});
  }
  impl_->changed.notify_one();
}

void CallbackQueue::removeByID(uint64_t removal_id) {
  std::deque<Implementation::Entry> removed;  // destroyed after the lock is released
  std::unique_lock<std::mutex> lock(impl_->mutex);
  auto& entries = impl_->entries;
  for (auto entry = entries.begin(); entry != entries.end();) {
    if (entry->owner != removal_id) {
      ++entry;
      continue;
    }
    removed.push_back(*entry);
    entry = entries.erase(entry);
  }
  const auto calls = impl_->running.equal_range(removal_id);
  std::for_each(calls.first, calls.second, [](auto& call) { call.second.is_removed = true; });
  const auto runsNoMore = [&] {
    const auto left = impl_->running.equal_range(removal_id);
    return std::none_of(left.first, left.second,
                        [](const auto& call) { return call.second.thread != std::this_thread::get_id(); });
  };
  if (impl_->changed.wait_for(lock, kPatience, runsNoMore)) return;
  lock.unlock();
  ROS_WARN(
      "A callback still runs %d s after its subscriber, service or timer was shut down, perhaps waiting for the "
      "thread that did so; it goes on, and what it uses must outlive it",
      static_cast<int>(kPatience.count()));
}

CallbackQueue::CallOneResult CallbackQueue::callOne(WallDuration timeout) {
  const boost::shared_ptr<Implementation> impl = impl_;
  std::unique_lock<std::mutex> lock(impl->mutex);
  if (!impl->is_enabled) return Disabled;
  impl->waitForReady(lock, timeout);
  return impl->is_enabled ? impl->run(lock) : Disabled;
}

void CallbackQueue::callAvailable(WallDuration timeout) {
  const boost::shared_ptr<Implementation> impl = impl_;  // a call may destroy the queue
  std::unique_lock<std::mutex> lock(impl->mutex);
  if (!impl->waitForReady(lock, timeout)) return;
  // Calls added from now on wait for the next callAvailable().
  for (size_t count = impl->entries.size(); count > 0 && impl->is_enabled; --count)
    if (impl->run(lock) != Called) break;
}

bool CallbackQueue::isEmpty() {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  return impl_->entries.empty() && impl_->running.empty();
}

void CallbackQueue::clear() {
  std::deque<Implementation::Entry> removed;
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  removed.swap(impl_->entries);
}

void CallbackQueue::enable() {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->is_enabled = true;
  impl_->changed.notify_all();
}

void CallbackQueue::disable() {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  impl_->is_enabled = false;
  impl_->changed.notify_all();
}

bool CallbackQueue::isEnabled() {
  const std::lock_guard<std::mutex> lock(impl_->mutex);
  return impl_->is_enabled;
}

}  // namespace ros
