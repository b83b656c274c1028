#pragma once

#include <message_filters/simple_filter.h>
#include <ros/callback_queue_interface.h>
#include <ros/node_handle.h>
#include <tf2/buffer_core.h>

#include <list>
#include <mutex>
#include <string>
#include <vector>

namespace tf2_ros {

namespace filter_failure_reasons {
/** Why a message is dropped. */
enum FilterFailureReason {
  /** The queue is full. */
  Unknown,
  /** Its stamp is before all transforms that are kept. */
  OutTheBack,
  EmptyFrameID,
};
}  // namespace filter_failure_reasons
typedef filter_failure_reasons::FilterFailureReason FilterFailureReason;

class MessageFilterBase {
 public:
  typedef std::vector<std::string> V_string;
  virtual ~MessageFilterBase() {}
  virtual void clear() = 0;
  virtual void setTargetFrame(const std::string& target_frame) = 0;
  virtual void setTargetFrames(const V_string& target_frames) = 0;
  virtual void setTolerance(const ros::Duration& tolerance) = 0;
};

/** Filter that passes messages on once their frame can be transformed to all target frames at their stamp. */
template <class M>
class MessageFilter : public MessageFilterBase, public message_filters::SimpleFilter<M> {
 public:
  typedef boost::shared_ptr<M const> MConstPtr;
  typedef ros::MessageEvent<M const> MEvent;
  typedef boost::function<void(const MConstPtr&, FilterFailureReason)> FailureCallback;

  /** `queue_size`: messages that wait; the oldest is dropped. 0: no limit. Callbacks run where the node's do. */
  MessageFilter(tf2::BufferCore& buffer, const std::string& target_frame, uint32_t queue_size,
                const ros::NodeHandle& nh)
      : MessageFilter(buffer, target_frame, queue_size, nh.getCallbackQueue()) {}
  template <class F>
  MessageFilter(F& f, tf2::BufferCore& buffer, const std::string& target_frame, uint32_t queue_size,
                const ros::NodeHandle& nh)
      : MessageFilter(f, buffer, target_frame, queue_size, nh.getCallbackQueue()) {}
  /** Without a queue, callbacks run in the thread that adds the message, or the transform. */
  MessageFilter(tf2::BufferCore& buffer, const std::string& target_frame, uint32_t queue_size,
                ros::CallbackQueueInterface* callback_queue)
      : buffer_(buffer), queue_size_(queue_size), callback_queue_(callback_queue) {
    setTargetFrame(target_frame);
    listener_ = buffer_.addTransformsListener([this] { passOn(callback_queue_); });
  }
  template <class F>
  MessageFilter(F& f, tf2::BufferCore& buffer, const std::string& target_frame, uint32_t queue_size,
                ros::CallbackQueueInterface* callback_queue)
      : MessageFilter(buffer, target_frame, queue_size, callback_queue) {
    connectInput(f);
  }
  ~MessageFilter() {
    incoming_.disconnect();
    buffer_.removeTransformsListener(listener_);
    clear();
  }

  template <class F>
  void connectInput(F& f) {
    incoming_.disconnect();
    incoming_ = f.registerCallback(
        typename message_filters::SimpleFilter<M>::EventCallback([this](const MEvent& event) { add(event); }));
  }
  void setTargetFrame(const std::string& target_frame) override { setTargetFrames(V_string(1, target_frame)); }
  void setTargetFrames(const V_string& target_frames) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    target_frames_.clear();
    for (const std::string& frame : target_frames) target_frames_.push_back(stripSlash(frame));
  }
  std::string getTargetFramesString() {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::string text;
    for (const std::string& frame : target_frames_) text += (text.empty() ? "" : " ") + frame;
    return text;
  }
  /** Time after the stamp at which transforms are needed as well. */
  void setTolerance(const ros::Duration& tolerance) override {
    const std::lock_guard<std::mutex> lock(mutex_);
    tolerance_ = tolerance;
  }
  void setQueueSize(uint32_t queue_size) {
    const std::lock_guard<std::mutex> lock(mutex_);
    queue_size_ = queue_size;
  }
  uint32_t getQueueSize() { return queue_size_; }
  /** Drop what waits. */
  void clear() override {
    if (callback_queue_) callback_queue_->removeByID(reinterpret_cast<uint64_t>(this));
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.clear();
  }

  /** Add a message that no subscriber received; its receipt has wall time, which programs without a node have too. */
  void add(const MConstPtr& message) {
    const ros::WallTime now = ros::WallTime::now();
    add(MEvent(message, ros::Time(now.sec, now.nsec)));
  }
  void add(const MEvent& event) {
    std::list<Outcome> outcomes;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (frame(event).empty()) {
        outcomes.push_back(Outcome{event, filter_failure_reasons::EmptyFrameID, true});
      } else {
        if (queue_size_ > 0 && waiting_.size() >= queue_size_ && !isReady(event)) {
          outcomes.push_back(Outcome{waiting_.front(), filter_failure_reasons::Unknown, true});
          waiting_.pop_front();
        }
        waiting_.push_back(event);
      }
    }
    ros::CallbackQueueInterface* const queue = runs_at_add_ ? nullptr : callback_queue_;
    for (const Outcome& outcome : outcomes) finish(outcome, queue);
    passOn(queue);
  }

  /** Connect a callback for messages that are dropped. */
  message_filters::Connection registerFailureCallback(const FailureCallback& callback) {
    const std::lock_guard<std::mutex> lock(mutex_);
    failure_callbacks_.push_back(callback);
    const auto place = std::prev(failure_callbacks_.end());
    return message_filters::Connection([this, place] {
      const std::lock_guard<std::mutex> lock(mutex_);
      failure_callbacks_.erase(place);
    });
  }

 protected:
  /** Let `add` itself call what is ready then, in its thread, whatever the queue. */
  void runAtAdd() { runs_at_add_ = true; }

 private:
  struct Outcome {
    MEvent event;
    FilterFailureReason reason;
    bool is_failure;
  };
  class Call : public ros::CallbackInterface {
   public:
    Call(MessageFilter& filter, const Outcome& outcome) : filter_(filter), outcome_(outcome) {}
    CallResult call() override {
      filter_.report(outcome_);
      return Success;
    }

   private:
    MessageFilter& filter_;
    Outcome outcome_;
  };

  static std::string stripSlash(const std::string& frame) {
    return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame;
  }
  static std::string frame(const MEvent& event) {
    return stripSlash(ros::message_traits::FrameId<M>::value(*event.getMessage()));
  }
  static ros::Time stamp(const MEvent& event) { return ros::message_traits::TimeStamp<M>::value(*event.getMessage()); }

  bool isReady(const MEvent& event) const {
    const std::string source = frame(event);
    const ros::Time time = stamp(event);
    for (const std::string& target : target_frames_) {
      if (!buffer_.canTransform(target, source, time)) return false;
      if (!tolerance_.isZero() && !buffer_.canTransform(target, source, time + tolerance_)) return false;
    }
    return true;
  }
  /** True if transforms of the stamp were forgotten: they never come. */
  bool isTooOld(const MEvent& event) const {
    const std::string source = frame(event);
    for (const std::string& target : target_frames_) {
      if (target == source || !buffer_.frameExists(target) || !buffer_.frameExists(source)) continue;
      try {
        const ros::Time latest = buffer_.getLatestCommonTime(target, source);
        if (!latest.isZero() && stamp(event).toSec() + buffer_.getCacheLength().toSec() < latest.toSec()) return true;
      } catch (const tf2::TransformException&) {  // not connected yet
      }
    }
    return false;
  }

  void passOn(ros::CallbackQueueInterface* queue) {
    std::list<Outcome> outcomes;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (auto event = waiting_.begin(); event != waiting_.end();) {
        const bool is_ready = isReady(*event);
        if (!is_ready && !isTooOld(*event)) {
          ++event;
          continue;
        }
        outcomes.push_back(Outcome{*event, filter_failure_reasons::OutTheBack, !is_ready});
        event = waiting_.erase(event);
      }
    }
    for (const Outcome& outcome : outcomes) finish(outcome, queue);
  }

  void finish(const Outcome& outcome, ros::CallbackQueueInterface* queue) {
    if (queue) queue->addCallback(boost::make_shared<Call>(*this, outcome), reinterpret_cast<uint64_t>(this));
    else report(outcome);
  }
  void report(const Outcome& outcome) {
    if (!outcome.is_failure) {
      this->signalMessage(outcome.event);
      return;
    }
    std::list<FailureCallback> callbacks;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      callbacks = failure_callbacks_;
    }
    for (const FailureCallback& callback : callbacks) callback(outcome.event.getMessage(), outcome.reason);
  }

  tf2::BufferCore& buffer_;
  std::mutex mutex_;
  V_string target_frames_;
  uint32_t queue_size_;
  ros::Duration tolerance_;
  ros::CallbackQueueInterface* callback_queue_;
  bool runs_at_add_ = false;
  std::list<MEvent> waiting_;
  std::list<FailureCallback> failure_callbacks_;
  size_t listener_ = 0;
  message_filters::Connection incoming_;
};

}  // namespace tf2_ros
