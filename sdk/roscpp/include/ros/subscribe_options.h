#pragma once

#include "ros/common.h"
#include "ros/subscription_callback_helper.h"
#include "ros/transport_hints.h"

namespace ros {

struct SubscribeOptions {
  SubscribeOptions() {}
  SubscribeOptions(const std::string& topic_, uint32_t queue_size_, const std::string& md5sum_,
                   const std::string& datatype_)
      : topic(topic_), queue_size(queue_size_), md5sum(md5sum_), datatype(datatype_) {}

  template <class P>
  void initByFullCallbackType(const std::string& topic_, uint32_t queue_size_, const boost::function<void(P)>& callback,
                              const boost::function<boost::shared_ptr<typename ParameterAdapter<P>::Message>(void)>&
                                  create = DefaultMessageCreator<typename ParameterAdapter<P>::Message>()) {
    typedef typename ParameterAdapter<P>::Message Message;
    topic = topic_;
    queue_size = queue_size_;
    md5sum = message_traits::md5sum<Message>();
    datatype = message_traits::datatype<Message>();
    helper = boost::make_shared<SubscriptionCallbackHelperT<P> >(callback, create);
  }
  template <class M>
  void init(const std::string& topic_, uint32_t queue_size_,
            const boost::function<void(const boost::shared_ptr<M const>&)>& callback,
            const boost::function<boost::shared_ptr<M>(void)>& create = DefaultMessageCreator<M>()) {
    topic = topic_;
    queue_size = queue_size_;
    md5sum = message_traits::md5sum<M>();
    datatype = message_traits::datatype<M>();
    helper = boost::make_shared<SubscriptionCallbackHelperT<const boost::shared_ptr<M const>&> >(callback, create);
  }
  template <class M>
  static SubscribeOptions create(const std::string& topic, uint32_t queue_size,
                                 const boost::function<void(const boost::shared_ptr<M const>&)>& callback,
                                 const VoidConstPtr& tracked_object, CallbackQueueInterface* queue) {
    SubscribeOptions options;
    options.init<M>(topic, queue_size, callback);
    options.tracked_object = tracked_object;
    options.callback_queue = queue;
    return options;
  }

  std::string topic;
  /** Maximum number of messages that wait for the callback; the oldest are dropped. 0: no limit. */
  uint32_t queue_size = 1;
  std::string md5sum, datatype;
  SubscriptionCallbackHelperPtr helper;
  CallbackQueueInterface* callback_queue = nullptr;
  /** True: several threads may run the callback at the same time. */
  bool allow_concurrent_callbacks = false;
  /** The callback is called only while this object exists. */
  VoidConstPtr tracked_object;
  TransportHints transport_hints;
};

}  // namespace ros
