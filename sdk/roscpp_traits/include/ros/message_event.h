#pragma once

#include <boost/function.hpp>
#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>
#include <boost/type_traits/add_const.hpp>
#include <boost/type_traits/is_const.hpp>
#include <boost/type_traits/is_void.hpp>
#include <boost/type_traits/remove_const.hpp>
#include <boost/utility/enable_if.hpp>
#include <string>

#include "ros/datatypes.h"
#include "ros/message_traits.h"
#include "ros/time.h"

namespace ros {

/** Creates messages by the type's constructor without arguments. */
template <typename M>
struct DefaultMessageCreator {
  boost::shared_ptr<M> operator()() { return boost::make_shared<M>(); }
};

/** Received message, its time of arrival and the header of its connection. */
template <typename M>
class MessageEvent {
 public:
  typedef typename boost::add_const<M>::type ConstMessage;
  typedef typename boost::remove_const<M>::type Message;
  typedef boost::shared_ptr<Message> MessagePtr;
  typedef boost::shared_ptr<ConstMessage> ConstMessagePtr;
  typedef boost::function<MessagePtr()> CreateFunction;

  MessageEvent() : nonconst_need_copy_(true) {}
  template <typename Other>
  MessageEvent(const MessageEvent<Other>& o) {
    init(boost::const_pointer_cast<Message>(o.getConstMessage()), o.getConnectionHeaderPtr(), o.getReceiptTime(),
         o.nonConstWillCopy(), CreateFunction());
  }
  /** Typed event of a type-erased one; `nonconst_need_copy`: callbacks that may change the message get a copy. */
  MessageEvent(const MessageEvent<void const>& o, const CreateFunction& create) {
    init(boost::const_pointer_cast<Message>(boost::static_pointer_cast<ConstMessage>(o.getConstMessage())),
         o.getConnectionHeaderPtr(), o.getReceiptTime(), o.nonConstWillCopy(), create);
  }
  MessageEvent(const MessageEvent<void const>& o, bool nonconst_need_copy) {
    init(boost::const_pointer_cast<Message>(boost::static_pointer_cast<ConstMessage>(o.getConstMessage())),
         o.getConnectionHeaderPtr(), o.getReceiptTime(), nonconst_need_copy, CreateFunction());
  }
  MessageEvent(const ConstMessagePtr& message) {
    init(message, boost::shared_ptr<M_string>(), ros::Time::now(), true, CreateFunction());
  }
  MessageEvent(const ConstMessagePtr& message, ros::Time receipt_time) {
    init(message, boost::shared_ptr<M_string>(), receipt_time, true, CreateFunction());
  }
  MessageEvent(const ConstMessagePtr& message, const boost::shared_ptr<M_string>& connection_header,
               ros::Time receipt_time) {
    init(message, connection_header, receipt_time, true, CreateFunction());
  }
  MessageEvent(const ConstMessagePtr& message, const boost::shared_ptr<M_string>& connection_header,
               ros::Time receipt_time, bool nonconst_need_copy, const CreateFunction& create) {
    init(message, connection_header, receipt_time, nonconst_need_copy, create);
  }

  void init(const ConstMessagePtr& message, const boost::shared_ptr<M_string>& connection_header,
            ros::Time receipt_time, bool nonconst_need_copy, const CreateFunction& create) {
    message_ = message;
    message_copy_.reset();
    connection_header_ = connection_header;
    receipt_time_ = receipt_time;
    nonconst_need_copy_ = nonconst_need_copy;
    create_ = create;
  }

  /** The message; a copy of its own if M is not const and others share it. */
  boost::shared_ptr<M> getMessage() const { return copyIfNeeded<M>(); }
  const boost::shared_ptr<ConstMessage>& getConstMessage() const { return message_; }
  M_string& getConnectionHeader() const { return *connection_header_; }
  const boost::shared_ptr<M_string>& getConnectionHeaderPtr() const { return connection_header_; }
  /** Name of the node that published it. */
  std::string getPublisherName() const {
    if (!connection_header_) return "unknown_publisher";
    const M_string::const_iterator found = connection_header_->find("callerid");
    return found == connection_header_->end() ? "unknown_publisher" : found->second;
  }
  ros::Time getReceiptTime() const { return receipt_time_; }
  bool nonConstWillCopy() const { return nonconst_need_copy_; }
  bool getMessageWillCopy() const { return !boost::is_const<M>::value && nonconst_need_copy_; }
  const CreateFunction& getMessageFactory() const { return create_; }

  bool operator<(const MessageEvent& o) const {
    if (message_ != o.message_) return message_ < o.message_;
    if (receipt_time_ != o.receipt_time_) return receipt_time_ < o.receipt_time_;
    return nonconst_need_copy_ < o.nonconst_need_copy_;
  }
  bool operator==(const MessageEvent& o) const {
    return message_ == o.message_ && receipt_time_ == o.receipt_time_ && nonconst_need_copy_ == o.nonconst_need_copy_;
  }
  bool operator!=(const MessageEvent& o) const { return !(*this == o); }

 private:
  template <typename X>
  typename boost::enable_if<boost::is_void<X>, boost::shared_ptr<M> >::type copyIfNeeded() const {
    return boost::const_pointer_cast<Message>(message_);
  }
  template <typename X>
  typename boost::enable_if_c<boost::is_const<X>::value && !boost::is_void<X>::value, boost::shared_ptr<M> >::type
  copyIfNeeded() const {
    return message_;
  }
  template <typename X>
  typename boost::enable_if_c<!boost::is_const<X>::value && !boost::is_void<X>::value, boost::shared_ptr<M> >::type
  copyIfNeeded() const {
    if (!nonconst_need_copy_) return boost::const_pointer_cast<Message>(message_);
    if (!message_copy_ && message_) {
      message_copy_ = create_ ? create_() : boost::make_shared<Message>();
      *message_copy_ = *message_;
    }
    return message_copy_;
  }

  ConstMessagePtr message_;
  mutable MessagePtr message_copy_;
  boost::shared_ptr<M_string> connection_header_;
  ros::Time receipt_time_;
  bool nonconst_need_copy_;
  CreateFunction create_;
};

}  // namespace ros
