#pragma once

#include <ros/single_subscriber_publisher.h>
#include <sensor_msgs/Image.h>

namespace image_transport {

/** Publisher to a subscriber that has just come. */
class SingleSubscriberPublisher {
 public:
  explicit SingleSubscriberPublisher(const ros::SingleSubscriberPublisher& publisher) : publisher_(publisher) {}
  std::string getSubscriberName() const { return publisher_.getSubscriberName(); }
  std::string getTopic() const { return publisher_.getTopic(); }
  void publish(const sensor_msgs::Image& message) const { publisher_.publish(message); }
  void publish(const sensor_msgs::ImageConstPtr& message) const { publisher_.publish(*message); }

 private:
  const ros::SingleSubscriberPublisher& publisher_;
};
typedef boost::function<void(const SingleSubscriberPublisher&)> SubscriberStatusCallback;

}  // namespace image_transport
