#pragma once

#include <typeinfo>

#include "ros/common.h"
#include "ros/message_event.h"
#include "ros/message_traits.h"
#include "ros/parameter_adapter.h"
#include "ros/serialization.h"

namespace ros {

struct SubscriptionCallbackHelperDeserializeParams {
  uint8_t* buffer;
  uint32_t length;
  boost::shared_ptr<M_string> connection_header;
};
struct SubscriptionCallbackHelperCallParams {
  MessageEvent<void const> event;
};

/** A callback, and the deserializer of its message's type. */
class SubscriptionCallbackHelper {
 public:
  virtual ~SubscriptionCallbackHelper() {}
  virtual VoidConstPtr deserialize(const SubscriptionCallbackHelperDeserializeParams&) = 0;
  virtual void call(SubscriptionCallbackHelperCallParams& params) = 0;
  virtual const std::type_info& getTypeInfo() = 0;
  virtual bool isConst() = 0;
  virtual bool hasHeader() = 0;
};

template <typename P, typename Enabled = void>
class SubscriptionCallbackHelperT : public SubscriptionCallbackHelper {
 public:
  typedef ParameterAdapter<P> Adapter;
  typedef typename Adapter::Message NonConstType;
  typedef typename Adapter::Event Event;
  typedef boost::shared_ptr<NonConstType> NonConstTypePtr;
  typedef boost::function<void(typename Adapter::Parameter)> Callback;
  typedef boost::function<NonConstTypePtr()> CreateFunction;

  SubscriptionCallbackHelperT(const Callback& callback,
                              const CreateFunction& create = DefaultMessageCreator<NonConstType>())
      : callback_(callback), create_(create) {}

  virtual bool hasHeader() { return message_traits::hasHeader<NonConstType>(); }
  virtual bool isConst() { return Adapter::is_const; }
  virtual const std::type_info& getTypeInfo() { return typeid(NonConstType); }

  virtual VoidConstPtr deserialize(const SubscriptionCallbackHelperDeserializeParams& params) {
    NonConstTypePtr message = create_();
    if (!message) return VoidConstPtr();
    serialization::PreDeserializeParams<NonConstType> before;
    before.message = message;
    before.connection_header = params.connection_header;
    serialization::PreDeserialize<NonConstType>::notify(before);
    serialization::IStream stream(params.buffer, params.length);
    serialization::deserialize(stream, *message);
    return VoidConstPtr(message);
  }

  virtual void call(SubscriptionCallbackHelperCallParams& params) {
    Event event(params.event, create_);
    callback_(Adapter::getParameter(event));
  }

 private:
  Callback callback_;
  CreateFunction create_;
};

}  // namespace ros
