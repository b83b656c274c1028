// Queues of messages that a thread of their own publishes, so that a plugin's update never waits.
#ifndef GAZEBO_PLUGINS_PUBQUEUE_H
#define GAZEBO_PLUGINS_PUBQUEUE_H

#include <ros/ros.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include <boost/function.hpp>
#include <boost/shared_ptr.hpp>

// A message and its publisher.
template <class T>
class PubMessagePair {
 public:
  PubMessagePair(T& message, ros::Publisher& publisher) : msg_(message), pub_(publisher) {}
  T msg_;
  ros::Publisher pub_;
};

// Messages of one type that wait to be published.
template <class T>
class PubQueue {
 public:
  typedef boost::shared_ptr<std::deque<boost::shared_ptr<PubMessagePair<T> > > > QueuePtr;
  typedef boost::shared_ptr<PubQueue<T> > Ptr;

  explicit PubQueue(boost::function<void()> notify)
      : notify_(notify), queue_(new std::deque<boost::shared_ptr<PubMessagePair<T> > >) {}
  void push(T& message, ros::Publisher& publisher) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      queue_->push_back(boost::shared_ptr<PubMessagePair<T> >(new PubMessagePair<T>(message, publisher)));
    }
    notify_();
  }
  // Take all messages out.
  void pop(std::vector<boost::shared_ptr<PubMessagePair<T> > >& els) {
    const std::lock_guard<std::mutex> lock(mutex_);
    els.insert(els.end(), queue_->begin(), queue_->end());
    queue_->clear();
  }

 private:
  boost::function<void()> notify_;
  QueuePtr queue_;
  std::mutex mutex_;
};

// Queues of several types, and their thread.
class PubMultiQueue {
 public:
  PubMultiQueue() {}
  PubMultiQueue(const PubMultiQueue&) = delete;
  PubMultiQueue& operator=(const PubMultiQueue&) = delete;
  ~PubMultiQueue() {
    {
      const std::lock_guard<std::mutex> lock(wake_mutex_);
      is_running_ = false;
    }
    wake_.notify_all();
    if (thread_.joinable()) thread_.join();
  }

  // Queue of another type.
  template <class T>
  boost::shared_ptr<PubQueue<T> > addPub() {
    const boost::shared_ptr<PubQueue<T> > queue(new PubQueue<T>([this] { wake(); }));
    const std::lock_guard<std::mutex> lock(queues_mutex_);
    queues_.push_back([queue] {
      std::vector<boost::shared_ptr<PubMessagePair<T> > > messages;
      queue->pop(messages);
      for (const boost::shared_ptr<PubMessagePair<T> >& message : messages) message->pub_.publish(message->msg_);
    });
    return queue;
  }
  // Publish what waits.
  void spinOnce() {
    const std::lock_guard<std::mutex> lock(queues_mutex_);
    for (const std::function<void()>& queue : queues_) queue();
  }
  // Publish what comes, until the end of ROS.
  void spin() {
    while (ros::ok() && is_running_) {
      std::unique_lock<std::mutex> lock(wake_mutex_);
      wake_.wait_for(lock, std::chrono::milliseconds(100), [this] { return is_woken_ || !is_running_; });
      is_woken_ = false;
      lock.unlock();
      spinOnce();
    }
  }
  // Run spin() in a thread of its own.
  void startServiceThread() {
    if (!thread_.joinable()) thread_ = std::thread([this] { spin(); });
  }
  void notifyServiceThread() { wake(); }

 private:
  void wake() {
    {
      const std::lock_guard<std::mutex> lock(wake_mutex_);
      is_woken_ = true;
    }
    wake_.notify_one();
  }

  std::vector<std::function<void()> > queues_;
  std::mutex queues_mutex_, wake_mutex_;
  std::condition_variable wake_;
  std::atomic<bool> is_running_{true};
  bool is_woken_ = false;
  std::thread thread_;
};

#endif
