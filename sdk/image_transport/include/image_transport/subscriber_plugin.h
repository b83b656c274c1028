#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/Image.h>

#include "image_transport/transport_hints.h"

namespace image_transport {

/** Base of the plugins that receive images in a form of their own. */
class SubscriberPlugin {
 public:
  typedef boost::function<void(const sensor_msgs::ImageConstPtr&)> Callback;

  SubscriberPlugin() {}
  SubscriberPlugin(const SubscriberPlugin&) = delete;
  SubscriberPlugin& operator=(const SubscriberPlugin&) = delete;
  virtual ~SubscriberPlugin() {}

  /** Name such as "compressed". */
  virtual std::string getTransportName() const = 0;
  void subscribe(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size, const Callback& callback,
                 const ros::VoidPtr& tracked_object = ros::VoidPtr(),
                 const TransportHints& transport_hints = TransportHints()) {
    subscribeImpl(nh, base_topic, queue_size, callback, tracked_object, transport_hints);
  }
  void subscribe(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                 void (*fp)(const sensor_msgs::ImageConstPtr&),
                 const TransportHints& transport_hints = TransportHints()) {
    subscribe(nh, base_topic, queue_size, Callback(fp), ros::VoidPtr(), transport_hints);
  }
  template <class T>
  void subscribe(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                 void (T::*fp)(const sensor_msgs::ImageConstPtr&), T* obj,
                 const TransportHints& transport_hints = TransportHints()) {
    subscribe(nh, base_topic, queue_size, Callback(boost::bind(fp, obj, _1)), ros::VoidPtr(), transport_hints);
  }
  template <class T>
  void subscribe(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                 void (T::*fp)(const sensor_msgs::ImageConstPtr&), const boost::shared_ptr<T>& obj,
                 const TransportHints& transport_hints = TransportHints()) {
    subscribe(nh, base_topic, queue_size, Callback(boost::bind(fp, obj.get(), _1)), obj, transport_hints);
  }
  /** Topic of this transport. */
  virtual std::string getTopic() const = 0;
  virtual uint32_t getNumPublishers() const = 0;
  virtual void shutdown() = 0;
  /** Name of a transport's plugin. */
  static std::string getLookupName(const std::string& transport_name) {
    return "image_transport/" + transport_name + "_sub";
  }

 protected:
  virtual void subscribeImpl(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                             const Callback& callback, const ros::VoidPtr& tracked_object,
                             const TransportHints& transport_hints) = 0;
};

}  // namespace image_transport
