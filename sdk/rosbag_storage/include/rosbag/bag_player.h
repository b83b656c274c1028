#pragma once

#include <boost/function.hpp>
#include <boost/make_shared.hpp>
#include <map>
#include <string>

#include "rosbag/bag.h"
#include "rosbag/view.h"

namespace rosbag {

struct BagCallback {
  virtual ~BagCallback() {}
  virtual void call(MessageInstance m) = 0;
};

/** Function that gets messages of type T, or a null pointer for one of another type. */
template <class T>
class BagCallbackT : public BagCallback {
 public:
  typedef boost::function<void(const boost::shared_ptr<const T>&)> Callback;
  explicit BagCallbackT(Callback callback) : callback_(callback) {}
  void call(MessageInstance m) override { callback_(m.instantiate<T>()); }

 private:
  Callback callback_;
};

template <>
class BagCallbackT<MessageInstance> : public BagCallback {
 public:
  typedef boost::function<void(const MessageInstance&)> Callback;
  explicit BagCallbackT(Callback callback) : callback_(callback) {}
  void call(MessageInstance m) override { callback_(m); }

 private:
  Callback callback_;
};

/** Calls functions with the messages of a bag at the pace of their times. */
class BagPlayer {
 public:
  /** Throws BagException if the bag cannot be read. */
  explicit BagPlayer(const std::string& filename);
  virtual ~BagPlayer() {}

  template <class T>
  void register_callback(const std::string& topic, typename BagCallbackT<T>::Callback f) {
    callbacks_[topic] = boost::make_shared<BagCallbackT<T> >(f);
  }
  void unregister_callback(const std::string& topic) { callbacks_.erase(topic); }
  /** Times of the bag between which messages are played. */
  void set_start(const ros::Time& start) { start_ = start; }
  void set_end(const ros::Time& end) { end_ = end; }
  /** 2.0: twice as fast; must be positive, or the speed stays. */
  void set_playback_speed(double scale);
  /** Play all messages, and return. */
  void start_play();
  /** Time of the last message that was played. */
  ros::Time get_time() { return last_; }

  Bag bag;

 private:
  std::map<std::string, boost::shared_ptr<BagCallback> > callbacks_;
  ros::Time start_, end_, last_;
  double speed_ = 1.0;
};

}  // namespace rosbag
