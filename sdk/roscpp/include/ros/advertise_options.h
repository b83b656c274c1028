#pragma once

#include "ros/common.h"
#include "ros/message_traits.h"

namespace ros {

struct AdvertiseOptions {
  AdvertiseOptions() {}
  AdvertiseOptions(const std::string& topic_, uint32_t queue_size_, const std::string& md5sum_,
                   const std::string& datatype_, const std::string& definition,
                   const SubscriberStatusCallback& on_connect = SubscriberStatusCallback(),
                   const SubscriberStatusCallback& on_disconnect = SubscriberStatusCallback())
      : topic(topic_),
        queue_size(queue_size_),
        md5sum(md5sum_),
        datatype(datatype_),
        message_definition(definition),
        connect_cb(on_connect),
        disconnect_cb(on_disconnect) {}

  template <class M>
  void init(const std::string& topic_, uint32_t queue_size_,
            const SubscriberStatusCallback& on_connect = SubscriberStatusCallback(),
            const SubscriberStatusCallback& on_disconnect = SubscriberStatusCallback()) {
    topic = topic_;
    queue_size = queue_size_;
    connect_cb = on_connect;
    disconnect_cb = on_disconnect;
    md5sum = message_traits::md5sum<M>();
    datatype = message_traits::datatype<M>();
    message_definition = message_traits::definition<M>();
    has_header = message_traits::hasHeader<M>();
  }
  template <class M>
  static AdvertiseOptions create(const std::string& topic, uint32_t queue_size,
                                 const SubscriberStatusCallback& on_connect,
                                 const SubscriberStatusCallback& on_disconnect, const VoidConstPtr& tracked_object,
                                 CallbackQueueInterface* queue) {
    AdvertiseOptions options;
    options.init<M>(topic, queue_size, on_connect, on_disconnect);
    options.tracked_object = tracked_object;
    options.callback_queue = queue;
    return options;
  }

  std::string topic;
  /** Maximum number of messages that wait for each subscriber; the oldest are dropped. 0: no limit. */
  uint32_t queue_size = 0;
  std::string md5sum, datatype, message_definition;
  SubscriberStatusCallback connect_cb, disconnect_cb;
  CallbackQueueInterface* callback_queue = nullptr;
  VoidConstPtr tracked_object;
  /** True: each new subscriber gets the last message. */
  bool latch = false;
  bool has_header = false;
};

}  // namespace ros
