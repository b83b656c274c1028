#pragma once

#include <ros/single_subscriber_publisher.h>
#include <sensor_msgs/Image.h>

#include <string>

namespace image_transport {

/** Publisher to a subscriber that has just come, or gone. */
class SingleSubscriberPublisher {
 public:
  typedef boost::function<uint32_t()> GetNumSubscribersFn;
  typedef boost::function<void(const sensor_msgs::Image&)> PublishFn;

  SingleSubscriberPublisher(const std::string& caller_id, const std::string& topic,
                            const GetNumSubscribersFn& num_subscribers_fn, const PublishFn& publish_fn)
      : caller_id_(caller_id), topic_(topic), num_subscribers_(num_subscribers_fn), publish_(publish_fn) {}
  std::string getSubscriberName() const { return caller_id_; }
  std::string getTopic() const { return topic_; }
  uint32_t getNumSubscribers() const { return num_subscribers_(); }
  void publish(const sensor_msgs::Image& message) const { publish_(message); }
  void publish(const sensor_msgs::ImageConstPtr& message) const { publish_(*message); }

 private:
  std::string caller_id_, topic_;
  GetNumSubscribersFn num_subscribers_;
  PublishFn publish_;
};
typedef boost::function<void(const SingleSubscriberPublisher&)> SubscriberStatusCallback;

}  // namespace image_transport
