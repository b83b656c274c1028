// Timers of the three clocks.
#include <algorithm>
#include <boost/enable_shared_from_this.hpp>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <thread>

#include "node.h"
#include "ros/callback_queue_interface.h"
#include "ros/init.h"
#include "ros/steady_timer.h"
#include "ros/timer.h"
#include "ros/wall_timer.h"

namespace ros {
namespace {

/** Functions of a clock, in [ns]; waits in ROS time end whenever it changes. */
struct ClockKind {
  int64_t (*now)();
  bool (*is_simulated)();
};

int64_t rosNow() { return static_cast<int64_t>(Time::now().toNSec()); }
int64_t wallNow() { return static_cast<int64_t>(WallTime::now().toNSec()); }
int64_t steadyNow() { return static_cast<int64_t>(SteadyTime::now().toNSec()); }
bool never() { return false; }

}  // namespace

/** Times [ns] of a call. */
struct CallTimes {
  int64_t last_expected = 0, last_real = 0, current_expected = 0, current_real = 0, last_expired = 0,
          current_expired = 0;
  WallDuration last_duration;
};

class TimerImpl;

/** Thread that waits for the timers of one clock. */
class TimerLoop {
 public:
  explicit TimerLoop(const ClockKind& kind) : clock(kind) {}
  void add(const boost::shared_ptr<TimerImpl>& timer, int64_t due);
  void remove(const TimerImpl* timer);
  void wake() {
    const std::lock_guard<std::mutex> lock(mutex_);
    changed_.notify_all();
  }
  void stop();
  const ClockKind clock;

 private:
  void run();
  std::mutex mutex_;
  std::condition_variable changed_;
  struct Due {
    const TimerImpl* key;  // only compared, as the timer may be destroyed already
    boost::weak_ptr<TimerImpl> timer;
  };
  std::multimap<int64_t, Due> due_;
  std::thread thread_;
  bool is_running_ = false;
};

class TimerImpl : public boost::enable_shared_from_this<TimerImpl> {
 public:
  TimerImpl(TimerLoop& loop, int64_t period, bool oneshot, CallbackQueueInterface* queue, const VoidConstPtr& tracked,
            std::function<void(const CallTimes&)> callback)
      : loop_(loop), period_(period), is_oneshot_(oneshot), queue_(queue), callback_(std::move(callback)) {
    if (tracked) {
      is_tracking_ = true;
      tracked_ = tracked;
    }
  }
  ~TimerImpl() { stop(); }

  void start();
  void stop();
  bool hasStarted() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return is_started_;
  }
  bool hasPending() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_tracking_ && tracked_.expired()) return false;
    return is_started_ && (is_waiting_ || loop_.clock.now() >= next_);
  }
  void setPeriod(int64_t period, bool reset);
  /** Queue the call that is due. */
  void fire();
  void call(uint64_t generation);

 private:
  friend class TimerLoop;
  TimerLoop& loop_;
  int64_t period_;
  const bool is_oneshot_;
  CallbackQueueInterface* const queue_;
  boost::weak_ptr<void const> tracked_;
  bool is_tracking_ = false;
  std::function<void(const CallTimes&)> callback_;
  mutable std::mutex mutex_;
  bool is_started_ = false, is_waiting_ = false;
  uint64_t generation_ = 0;
  int64_t next_ = 0;
  CallTimes times_;
};

namespace {

class TimerCall : public CallbackInterface {
 public:
  TimerCall(const boost::shared_ptr<TimerImpl>& timer, uint64_t generation) : timer_(timer), generation_(generation) {}
  CallResult call() override {
    if (const boost::shared_ptr<TimerImpl> timer = timer_.lock()) timer->call(generation_);
    return Success;
  }

 private:
  boost::weak_ptr<TimerImpl> timer_;
  uint64_t generation_;
};

TimerLoop& rosLoop() {
  static TimerLoop* const loop = [] {
    impl::onTimeChange([] { rosLoop().wake(); });
    return new TimerLoop({rosNow, Time::isSimTime});
  }();
  return *loop;
}
TimerLoop& wallLoop() {
  static TimerLoop* const loop = new TimerLoop({wallNow, never});
  return *loop;
}
TimerLoop& steadyLoop() {
  static TimerLoop* const loop = new TimerLoop({steadyNow, never});
  return *loop;
}

}  // namespace

void TimerLoop::add(const boost::shared_ptr<TimerImpl>& timer, int64_t due) {
  const std::lock_guard<std::mutex> lock(mutex_);
  due_.emplace(due, Due{timer.get(), timer});
  if (!is_running_ && !isShuttingDown()) {
    if (thread_.joinable()) thread_.join();
    is_running_ = true;
    thread_ = std::thread([this] { run(); });
  }
  changed_.notify_all();
}

void TimerLoop::remove(const TimerImpl* timer) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto entry = due_.begin(); entry != due_.end();)
    entry = entry->second.key == timer ? due_.erase(entry) : std::next(entry);
}

void TimerLoop::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_running_ = false;
    changed_.notify_all();
  }
  if (thread_.joinable() && thread_.get_id() != std::this_thread::get_id()) thread_.join();
}

void TimerLoop::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (is_running_) {
    if (due_.empty()) {
      changed_.wait(lock);
      continue;
    }
    const int64_t rest = due_.begin()->first - clock.now();
    if (rest > 0 && clock.is_simulated()) {
      changed_.wait(lock);
      continue;
    }
    if (rest > 0) {
      changed_.wait_for(lock, std::chrono::nanoseconds(rest));
      continue;
    }
    boost::shared_ptr<TimerImpl> timer = due_.begin()->second.timer.lock();
    due_.erase(due_.begin());
    lock.unlock();
    if (timer) timer->fire();
    timer.reset();
    lock.lock();
  }
}

void TimerImpl::start() {
  int64_t due = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_started_) return;
    is_started_ = true;
    is_waiting_ = false;
    ++generation_;
    times_ = CallTimes();
    due = next_ = loop_.clock.now() + period_;
  }
  loop_.add(shared_from_this(), due);
}

void TimerImpl::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!is_started_) return;
    is_started_ = false;
    ++generation_;
  }
  loop_.remove(this);
  if (CallbackQueueInterface::exists(queue_)) queue_->removeByID(reinterpret_cast<uint64_t>(this));
}

void TimerImpl::setPeriod(int64_t period, bool reset) {
  int64_t due = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const int64_t now = loop_.clock.now();
    const int64_t last = next_ - period_;
    period_ = period;
    if (!is_started_ || is_waiting_) return;
    due = next_ = reset ? now + period : std::max(now, last + period);
  }
  loop_.remove(this);
  loop_.add(shared_from_this(), due);
}

void TimerImpl::fire() {
  uint64_t generation = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!is_started_ || is_waiting_) return;
    is_waiting_ = true;
    generation = generation_;
    times_.last_expired = times_.current_expired;
    times_.current_expired = loop_.clock.now();
  }
  queue_->addCallback(boost::make_shared<TimerCall>(shared_from_this(), generation), reinterpret_cast<uint64_t>(this));
}

void TimerImpl::call(uint64_t generation) {
  boost::shared_ptr<void const> tracked;
  CallTimes times;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (generation != generation_ || !is_started_) return;
    if (is_tracking_ && !(tracked = tracked_.lock())) return;
    times_.last_expected = times_.current_expected;
    times_.last_real = times_.current_real;
    times_.current_expected = next_;
    times_.current_real = loop_.clock.now();
    times = times_;
  }
  const WallTime start = WallTime::now();
  callback_(times);
  int64_t due = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    times_.last_duration = WallTime::now() - start;
    if (generation != generation_ || !is_started_) return;
    is_waiting_ = false;
    const int64_t now = loop_.clock.now();
    next_ += period_;
    // Missed calls are dropped; after a jump back in time, the next call is one period away at most.
    if (next_ < now) next_ = now;
    if (next_ > now + period_) next_ = now + period_;
    if (is_oneshot_) next_ = INT64_MAX;
    due = next_;
  }
  if (!is_oneshot_) loop_.add(shared_from_this(), due);
}

namespace {

template <class Event, class EventTime>
Event eventOf(const CallTimes& times) {
  Event event;
  event.last_expected = EventTime().fromNSec(static_cast<uint64_t>(times.last_expected));
  event.last_real = EventTime().fromNSec(static_cast<uint64_t>(times.last_real));
  event.current_expected = EventTime().fromNSec(static_cast<uint64_t>(times.current_expected));
  event.current_real = EventTime().fromNSec(static_cast<uint64_t>(times.current_real));
  event.last_expired = EventTime().fromNSec(static_cast<uint64_t>(times.last_expired));
  event.current_expired = EventTime().fromNSec(static_cast<uint64_t>(times.current_expired));
  event.profile.last_duration = times.last_duration;
  return event;
}

template <class Event, class EventTime, class Options>
boost::shared_ptr<TimerImpl> makeTimer(TimerLoop& loop, const Options& options) {
  const auto callback = options.callback;
  return boost::make_shared<TimerImpl>(
      loop, options.period.toNSec(), options.oneshot, options.callback_queue, options.tracked_object,
      [callback](const CallTimes& times) { callback(eventOf<Event, EventTime>(times)); });
}

}  // namespace

#define ROS_TIMER(Class, EventTime, Period, loop)                                                          \
  Class::Class(const Class##Options& options) : impl_(makeTimer<Class##Event, EventTime>(loop, options)) { \
    if (options.autostart) start();                                                                        \
  }                                                                                                        \
  void Class::start() {                                                                                    \
    if (impl_) impl_->start();                                                                             \
  }                                                                                                        \
  void Class::stop() {                                                                                     \
    if (impl_) impl_->stop();                                                                              \
  }                                                                                                        \
  bool Class::hasPending() { return impl_ && impl_->hasPending(); }                                        \
  bool Class::hasStarted() const { return impl_ && impl_->hasStarted(); }                                  \
  bool Class::isValid() const { return static_cast<bool>(impl_); }                                         \
  void Class::setPeriod(const Period& period, bool reset) {                                                \
    if (impl_) impl_->setPeriod(period.toNSec(), reset);                                                   \
  }
ROS_TIMER(Timer, Time, Duration, rosLoop())
ROS_TIMER(WallTimer, WallTime, WallDuration, wallLoop())
ROS_TIMER(SteadyTimer, SteadyTime, WallDuration, steadyLoop())
#undef ROS_TIMER

namespace timers {
void stop() {
  rosLoop().stop();
  wallLoop().stop();
  steadyLoop().stop();
}
}  // namespace timers

}  // namespace ros
