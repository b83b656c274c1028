#pragma once

#include <ros/node_handle.h>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

namespace realtime_tools {

/** Publisher for real-time threads: they fill `msg_`, and another thread publishes it. */
template <class Msg>
class RealtimePublisher {
 public:
  /** Message that is published next; it may be changed while it is locked. */
  Msg msg_;

  RealtimePublisher() {}
  RealtimePublisher(const ros::NodeHandle& node, const std::string& topic, int queue_size, bool latched = false) {
    init(node, topic, queue_size, latched);
  }
  RealtimePublisher(const RealtimePublisher&) = delete;
  RealtimePublisher& operator=(const RealtimePublisher&) = delete;
  ~RealtimePublisher() {
    stop();
    if (thread_.joinable()) thread_.join();
    publisher_.shutdown();
  }

  void init(const ros::NodeHandle& node, const std::string& topic, int queue_size, bool latched = false) {
    ros::NodeHandle own(node);
    publisher_ = own.advertise<Msg>(topic, static_cast<uint32_t>(queue_size), latched);
    is_running_ = true;
    thread_ = std::thread([this] { run(); });
  }
  void stop() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_running_ = false;
    changed_.notify_all();
  }

  /** Lock the message, if it is free at once and the one before was published. */
  bool trylock() {
    if (!mutex_.try_lock()) return false;
    if (!is_pending_) return true;
    mutex_.unlock();
    return false;
  }
  void lock() { mutex_.lock(); }
  void unlock() { mutex_.unlock(); }
  /** Publish the message, and unlock it. */
  void unlockAndPublish() {
    is_pending_ = true;
    mutex_.unlock();
    changed_.notify_one();
  }

 private:
  void run() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (is_running_) {
      changed_.wait(lock, [this] { return is_pending_ || !is_running_; });
      if (!is_pending_) continue;
      const Msg message = msg_;
      is_pending_ = false;
      lock.unlock();
      publisher_.publish(message);
      lock.lock();
    }
  }

  ros::Publisher publisher_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_running_ = false, is_pending_ = false;
  std::thread thread_;
};
template <class Msg>
using RealtimePublisherSharedPtr = std::shared_ptr<RealtimePublisher<Msg> >;

}  // namespace realtime_tools
