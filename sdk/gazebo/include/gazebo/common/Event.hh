// Events, and connections of functions with them.
#ifndef GAZEBO_COMMON_EVENT_HH_
#define GAZEBO_COMMON_EVENT_HH_

#include <algorithm>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <gazebo/trundle_host.h>
#include <gazebo/common/CommonTypes.hh>

namespace gazebo {
namespace event {

class Event {
 public:
  virtual ~Event() {}
  virtual void Disconnect(int) {}
  bool GetSignaled() const { return signaled_; }

 protected:
  bool signaled_ = false;
};

// Ends with its last pointer.
class Connection {
 public:
  Connection(Event* event, int id) : event_(event), id_(id) {}
  ~Connection() {
    if (event_) event_->Disconnect(id_);
  }
  int GetId() const { return id_; }
  int Id() const { return id_; }

 private:
  template <typename T>
  friend class EventT;
  Connection(const Connection&);
  Connection& operator=(const Connection&);

  Event* event_;
  int id_;
};

namespace internal {

// Plugin whose code runs, its world, and the simulator's interface; null: none.
struct Owner {
  const char* plugin;
  const void* world;
  const TrundleGazeboHost* host;
};
const Owner& CurrentOwner();
// Mark a plugin's code as running; return what ran before.
Owner Enter(const Owner& owner);
// Report an exception that is being handled.
void ReportException(const Owner& owner);

struct Running {
  explicit Running(const Owner& owner) : outer(Enter(owner)) {}
  ~Running() { Enter(outer); }
  const Owner outer;
};

}  // namespace internal

template <typename T>
class EventT;

template <typename... Args>
class EventT<void(Args...)> : public Event {
  struct Slot {
    int id;
    std::function<void(Args...)> function;
    internal::Owner owner;
    bool is_on;
  };

 public:
  typedef std::function<void(Args...)> CallbackT;

  // Plugins of hector_gazebo_plugins call it to disconnect all, and so twice: nothing is left for the second time, and
  // the compiler may not leave that out.
  virtual ~EventT() {
    std::vector<std::shared_ptr<Slot>>().swap(slots_);
    __asm__ __volatile__("" ::: "memory");
  }

  ConnectionPtr Connect(const CallbackT& function) {
    const std::lock_guard<std::mutex> lock(mutex_);
    slots_.push_back(std::make_shared<Slot>(Slot{++last_id_, function, internal::CurrentOwner(), true}));
    return std::make_shared<Connection>(this, last_id_);
  }
  // The connection may outlive the event from then on.
  void Disconnect(ConnectionPtr connection) {
    if (!connection) return;
    Disconnect(connection->GetId());
    connection->event_ = nullptr;
  }
  virtual void Disconnect(int id) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const std::shared_ptr<Slot>& slot : slots_)
      if (slot->id == id) slot->is_on = false;
    slots_.erase(std::remove_if(slots_.begin(), slots_.end(), [](const std::shared_ptr<Slot>& s) { return !s->is_on; }),
                 slots_.end());
  }
  unsigned int ConnectionCount() const { return static_cast<unsigned int>(slots_.size()); }

  // Call the functions that plugins of a world connected, or all if it is null, as in a thread of a plugin's own; one
  // that throws is disconnected.
  void SignalIn(const void* world, Args... args) { Call(world, nullptr, args...); }
  // The same for one of the plugins alone.
  void SignalTo(const internal::Owner& owner, Args... args) { Call(owner.world, owner.plugin, args...); }
  void Signal(Args... args) { SignalIn(internal::CurrentOwner().world, args...); }
  void operator()(Args... args) { Signal(args...); }

 private:
  // plugin: name of the plugin whose functions are called; null: those of all.
  void Call(const void* world, const char* plugin, Args... args) {
    signaled_ = true;
    for (std::size_t i = 0;; ++i) {
      const std::shared_ptr<Slot> slot = At(i);
      if (!slot) return;
      if (!slot->is_on || (world && slot->owner.world && slot->owner.world != world)) continue;
      if (plugin && slot->owner.plugin != plugin) continue;
      const internal::Running running(slot->owner);
      try {
        slot->function(args...);
      } catch (...) {
        internal::ReportException(slot->owner);
        slot->is_on = false;
      }
    }
  }
  std::shared_ptr<Slot> At(std::size_t index) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return index < slots_.size() ? slots_[index] : std::shared_ptr<Slot>();
  }

  std::mutex mutex_;
  std::vector<std::shared_ptr<Slot>> slots_;
  int last_id_ = 0;
};

}  // namespace event
}  // namespace gazebo

#endif
