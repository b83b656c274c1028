#include "image_transport/camera_subscriber.h"

#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>

#include <algorithm>

#include "image_transport/subscriber_filter.h"

namespace image_transport {

struct CameraSubscriber::Impl {
  Impl(ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size, const TransportHints& hints)
      : sync(images, infos, std::max(queue_size, 1u)) {
    ImageTransport transport(nh);
    images.subscribe(transport, topic, queue_size, hints);
    infos.subscribe(nh, getCameraInfoTopic(nh.resolveName(topic)), queue_size, hints.getRosHints());
  }
  SubscriberFilter images;
  message_filters::Subscriber<sensor_msgs::CameraInfo> infos;
  message_filters::TimeSynchronizer<sensor_msgs::Image, sensor_msgs::CameraInfo> sync;
};

CameraSubscriber::CameraSubscriber(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                                   const Callback& callback, const ros::VoidPtr& tracked_object,
                                   const TransportHints& transport_hints)
    : impl_(boost::make_shared<Impl>(nh, base_topic, queue_size, transport_hints)) {
  if (!tracked_object) {
    impl_->sync.registerCallback(callback);
    return;
  }
  const boost::weak_ptr<void> weak(tracked_object);
  impl_->sync.registerCallback(
      Callback([weak, callback](const sensor_msgs::ImageConstPtr& image, const sensor_msgs::CameraInfoConstPtr& info) {
        if (const ros::VoidPtr alive = weak.lock()) callback(image, info);
      }));
}

std::string CameraSubscriber::getTopic() const { return impl_ ? impl_->images.getTopic() : ""; }
std::string CameraSubscriber::getInfoTopic() const { return impl_ ? impl_->infos.getTopic() : ""; }

uint32_t CameraSubscriber::getNumPublishers() const {
  return impl_ ? std::max(impl_->images.getNumPublishers(), impl_->infos.getSubscriber().getNumPublishers()) : 0;
}

std::string CameraSubscriber::getTransport() const { return impl_ ? impl_->images.getTransport() : ""; }
void CameraSubscriber::shutdown() { impl_.reset(); }

}  // namespace image_transport
