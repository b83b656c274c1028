#pragma once

#include <ros/ros.h>

#include <vector>

#include "image_transport/camera_publisher.h"
#include "image_transport/camera_subscriber.h"
#include "image_transport/publisher.h"
#include "image_transport/subscriber.h"

namespace image_transport {

/** Advertises and subscribes images by plugins: raw, compressed, and those that packages export. */
class ImageTransport {
 public:
  typedef boost::function<void(const sensor_msgs::ImageConstPtr&)> ImageCallback;

  explicit ImageTransport(const ros::NodeHandle& nh) : node_(nh) {}

  Publisher advertise(const std::string& base_topic, uint32_t queue_size, bool latch = false) {
    return advertise(base_topic, queue_size, SubscriberStatusCallback(), SubscriberStatusCallback(), ros::VoidPtr(),
                     latch);
  }
  Publisher advertise(const std::string& base_topic, uint32_t queue_size, const SubscriberStatusCallback& connect_cb,
                      const SubscriberStatusCallback& disconnect_cb = SubscriberStatusCallback(),
                      const ros::VoidPtr& tracked_object = ros::VoidPtr(), bool latch = false) {
    return Publisher(node_, base_topic, queue_size, connect_cb, disconnect_cb, tracked_object, latch);
  }

  Subscriber subscribe(const std::string& base_topic, uint32_t queue_size, const ImageCallback& callback,
                       const ros::VoidPtr& tracked_object = ros::VoidPtr(),
                       const TransportHints& transport_hints = TransportHints()) {
    return Subscriber(node_, base_topic, queue_size, callback, tracked_object, transport_hints);
  }
  Subscriber subscribe(const std::string& base_topic, uint32_t queue_size,
                       void (*fp)(const sensor_msgs::ImageConstPtr&),
                       const TransportHints& transport_hints = TransportHints()) {
    return subscribe(base_topic, queue_size, ImageCallback(fp), ros::VoidPtr(), transport_hints);
  }
  template <class T>
  Subscriber subscribe(const std::string& base_topic, uint32_t queue_size,
                       void (T::*fp)(const sensor_msgs::ImageConstPtr&), T* obj,
                       const TransportHints& transport_hints = TransportHints()) {
    return subscribe(base_topic, queue_size, ImageCallback(boost::bind(fp, obj, _1)), ros::VoidPtr(), transport_hints);
  }
  template <class T>
  Subscriber subscribe(const std::string& base_topic, uint32_t queue_size,
                       void (T::*fp)(const sensor_msgs::ImageConstPtr&), const boost::shared_ptr<T>& obj,
                       const TransportHints& transport_hints = TransportHints()) {
    return subscribe(base_topic, queue_size, ImageCallback(boost::bind(fp, obj.get(), _1)), obj, transport_hints);
  }

  CameraPublisher advertiseCamera(const std::string& base_topic, uint32_t queue_size, bool latch = false) {
    return advertiseCamera(base_topic, queue_size, SubscriberStatusCallback(), SubscriberStatusCallback(),
                           ros::SubscriberStatusCallback(), ros::SubscriberStatusCallback(), ros::VoidPtr(), latch);
  }
  CameraPublisher advertiseCamera(
      const std::string& base_topic, uint32_t queue_size, const SubscriberStatusCallback& image_connect_cb,
      const SubscriberStatusCallback& image_disconnect_cb = SubscriberStatusCallback(),
      const ros::SubscriberStatusCallback& info_connect_cb = ros::SubscriberStatusCallback(),
      const ros::SubscriberStatusCallback& info_disconnect_cb = ros::SubscriberStatusCallback(),
      const ros::VoidPtr& tracked_object = ros::VoidPtr(), bool latch = false) {
    const std::string info = getCameraInfoTopic(node_.resolveName(base_topic));
    return CameraPublisher(
        advertise(base_topic, queue_size, image_connect_cb, image_disconnect_cb, tracked_object, latch),
        node_.advertise<sensor_msgs::CameraInfo>(info, queue_size, info_connect_cb, info_disconnect_cb, tracked_object,
                                                 latch));
  }

  CameraSubscriber subscribeCamera(const std::string& base_topic, uint32_t queue_size,
                                   const CameraSubscriber::Callback& callback,
                                   const ros::VoidPtr& tracked_object = ros::VoidPtr(),
                                   const TransportHints& transport_hints = TransportHints()) {
    return CameraSubscriber(node_, base_topic, queue_size, callback, tracked_object, transport_hints);
  }
  CameraSubscriber subscribeCamera(const std::string& base_topic, uint32_t queue_size,
                                   void (*fp)(const sensor_msgs::ImageConstPtr&,
                                              const sensor_msgs::CameraInfoConstPtr&),
                                   const TransportHints& transport_hints = TransportHints()) {
    return subscribeCamera(base_topic, queue_size, CameraSubscriber::Callback(fp), ros::VoidPtr(), transport_hints);
  }
  template <class T>
  CameraSubscriber subscribeCamera(const std::string& base_topic, uint32_t queue_size,
                                   void (T::*fp)(const sensor_msgs::ImageConstPtr&,
                                                 const sensor_msgs::CameraInfoConstPtr&),
                                   T* obj, const TransportHints& transport_hints = TransportHints()) {
    return subscribeCamera(base_topic, queue_size, CameraSubscriber::Callback(boost::bind(fp, obj, _1, _2)),
                           ros::VoidPtr(), transport_hints);
  }
  template <class T>
  CameraSubscriber subscribeCamera(const std::string& base_topic, uint32_t queue_size,
                                   void (T::*fp)(const sensor_msgs::ImageConstPtr&,
                                                 const sensor_msgs::CameraInfoConstPtr&),
                                   const boost::shared_ptr<T>& obj,
                                   const TransportHints& transport_hints = TransportHints()) {
    return subscribeCamera(base_topic, queue_size, CameraSubscriber::Callback(boost::bind(fp, obj.get(), _1, _2)), obj,
                           transport_hints);
  }

  /** Transports such as "image_transport/raw". */
  std::vector<std::string> getDeclaredTransports() const;
  /** Those of them whose library can be loaded. */
  std::vector<std::string> getLoadableTransports() const;

 private:
  ros::NodeHandle node_;
};

}  // namespace image_transport
