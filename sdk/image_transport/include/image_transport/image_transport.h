#pragma once

#include <ros/ros.h>

#include <vector>

#include "image_transport/camera_publisher.h"
#include "image_transport/camera_subscriber.h"
#include "image_transport/publisher.h"
#include "image_transport/subscriber.h"

namespace image_transport {

/** Advertises and subscribes images, as they are. */
class ImageTransport {
 public:
  typedef boost::function<void(const sensor_msgs::ImageConstPtr&)> ImageCallback;

  explicit ImageTransport(const ros::NodeHandle& nh) : node_(nh) {}

  Publisher advertise(const std::string& base_topic, uint32_t queue_size, bool latch = false) {
    return Publisher(node_.advertise<sensor_msgs::Image>(base_topic, queue_size, latch));
  }
  Publisher advertise(const std::string& base_topic, uint32_t queue_size, const SubscriberStatusCallback& connect_cb,
                      const SubscriberStatusCallback& disconnect_cb = SubscriberStatusCallback(),
                      const ros::VoidPtr& tracked_object = ros::VoidPtr(), bool latch = false) {
    return Publisher(node_.advertise<sensor_msgs::Image>(base_topic, queue_size, adapted(connect_cb),
                                                         adapted(disconnect_cb), tracked_object, latch));
  }

  Subscriber subscribe(const std::string& base_topic, uint32_t queue_size, const ImageCallback& callback,
                       const ros::VoidPtr& tracked_object = ros::VoidPtr(),
                       const TransportHints& transport_hints = TransportHints()) {
    requireRaw(transport_hints);
    return Subscriber(node_.subscribe<sensor_msgs::Image>(base_topic, queue_size, callback, tracked_object,
                                                          transport_hints.getRosHints()));
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
    const std::string info = getCameraInfoTopic(node_.resolveName(base_topic));
    return CameraPublisher(advertise(base_topic, queue_size, latch),
                           node_.advertise<sensor_msgs::CameraInfo>(info, queue_size, latch));
  }

  CameraSubscriber subscribeCamera(const std::string& base_topic, uint32_t queue_size,
                                   const CameraSubscriber::Callback& callback,
                                   const ros::VoidPtr& tracked_object = ros::VoidPtr(),
                                   const TransportHints& transport_hints = TransportHints()) {
    requireRaw(transport_hints);
    CameraSubscriber subscriber;
    subscriber.impl_ = boost::make_shared<CameraSubscriber::Impl>(node_, base_topic, queue_size, transport_hints);
    if (tracked_object) {
      const boost::weak_ptr<void> weak(tracked_object);
      subscriber.impl_->sync.registerCallback(CameraSubscriber::Callback(
          [weak, callback](const sensor_msgs::ImageConstPtr& image, const sensor_msgs::CameraInfoConstPtr& info) {
            if (const ros::VoidPtr alive = weak.lock()) callback(image, info);
          }));
    } else {
      subscriber.impl_->sync.registerCallback(callback);
    }
    return subscriber;
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

  std::vector<std::string> getDeclaredTransports() const { return std::vector<std::string>(1, "image_transport/raw"); }
  std::vector<std::string> getLoadableTransports() const { return getDeclaredTransports(); }

 private:
  static ros::SubscriberStatusCallback adapted(const SubscriberStatusCallback& callback) {
    if (!callback) return ros::SubscriberStatusCallback();
    return [callback](const ros::SingleSubscriberPublisher& peer) { callback(SingleSubscriberPublisher(peer)); };
  }

  ros::NodeHandle node_;
};

}  // namespace image_transport
