#pragma once

#include <boost/shared_ptr.hpp>
#include <boost/type_traits/remove_const.hpp>
#include <boost/type_traits/remove_reference.hpp>

#include "ros/forwards.h"
#include "ros/message_event.h"

namespace ros {

/** Type of the message for a callback's parameter, and whether the callback may change the message. */
template <typename M>
struct ParameterAdapter {
  typedef typename boost::remove_reference<typename boost::remove_const<M>::type>::type Message;
  typedef ros::MessageEvent<Message const> Event;
  typedef M Parameter;
  static const bool is_const = true;
  static Parameter getParameter(const Event& event) { return *event.getMessage(); }
};

template <typename M>
struct ParameterAdapter<const boost::shared_ptr<M const>&> {
  typedef typename boost::remove_reference<typename boost::remove_const<M>::type>::type Message;
  typedef ros::MessageEvent<Message const> Event;
  typedef const boost::shared_ptr<Message const> Parameter;
  static const bool is_const = true;
  static Parameter getParameter(const Event& event) { return event.getMessage(); }
};

template <typename M>
struct ParameterAdapter<const boost::shared_ptr<M>&> {
  typedef typename boost::remove_reference<typename boost::remove_const<M>::type>::type Message;
  typedef ros::MessageEvent<Message const> Event;
  typedef boost::shared_ptr<Message> Parameter;
  static const bool is_const = false;
  static Parameter getParameter(const Event& event) { return ros::MessageEvent<Message>(event).getMessage(); }
};

template <typename M>
struct ParameterAdapter<const M&> {
  typedef typename boost::remove_reference<typename boost::remove_const<M>::type>::type Message;
  typedef ros::MessageEvent<Message const> Event;
  typedef const M& Parameter;
  static const bool is_const = true;
  static Parameter getParameter(const Event& event) { return *event.getMessage(); }
};

template <typename M>
struct ParameterAdapter<boost::shared_ptr<M const> > {
  typedef typename boost::remove_reference<typename boost::remove_const<M>::type>::type Message;
  typedef ros::MessageEvent<Message const> Event;
  typedef boost::shared_ptr<Message const> Parameter;
  static const bool is_const = true;
  static Parameter getParameter(const Event& event) { return event.getMessage(); }
};

template <typename M>
struct ParameterAdapter<boost::shared_ptr<M> > {
  typedef typename boost::remove_reference<typename boost::remove_const<M>::type>::type Message;
  typedef ros::MessageEvent<Message const> Event;
  typedef boost::shared_ptr<Message> Parameter;
  static const bool is_const = false;
  static Parameter getParameter(const Event& event) { return ros::MessageEvent<Message>(event).getMessage(); }
};

template <typename M>
struct ParameterAdapter<const ros::MessageEvent<M const>&> {
  typedef typename boost::remove_reference<typename boost::remove_const<M>::type>::type Message;
  typedef ros::MessageEvent<Message const> Event;
  typedef const ros::MessageEvent<Message const>& Parameter;
  static const bool is_const = true;
  static Parameter getParameter(const Event& event) { return event; }
};

template <typename M>
struct ParameterAdapter<const ros::MessageEvent<M>&> {
  typedef typename boost::remove_reference<typename boost::remove_const<M>::type>::type Message;
  typedef ros::MessageEvent<Message const> Event;
  typedef ros::MessageEvent<Message> Parameter;
  static const bool is_const = false;
  static Parameter getParameter(const Event& event) { return ros::MessageEvent<Message>(event); }
};

}  // namespace ros
