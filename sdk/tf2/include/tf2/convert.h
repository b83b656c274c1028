#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/message_traits.h>
#include <ros/time.h>
#include <tf2/exceptions.h>

#include <string>

#include "tf2/LinearMath/Transform.h"
#include "tf2/transform_datatypes.h"

namespace tf2 {

/** Transforms a value; specialized per type, as in tf2_geometry_msgs. */
template <class T>
void doTransform(const T& data_in, T& data_out, const geometry_msgs::TransformStamped& transform);

template <class T>
const ros::Time& getTimestamp(const T& t) {
  return t.header.stamp;
}
template <class T>
const std::string& getFrameId(const T& t) {
  return t.header.frame_id;
}

namespace impl {

template <bool from_message, bool to_message>
struct Converter {
  template <class A, class B>
  static void convert(const A& a, B& b) {
    fromMsg(toMsg(a), b);
  }
};
template <>
struct Converter<true, false> {
  template <class A, class B>
  static void convert(const A& a, B& b) {
    fromMsg(a, b);
  }
};
template <>
struct Converter<false, true> {
  template <class A, class B>
  static void convert(const A& a, B& b) {
    b = toMsg(a);
  }
};

}  // namespace impl

/** Convert one representation to another, through toMsg() and fromMsg(). */
template <class A, class B>
void convert(const A& a, B& b) {
  impl::Converter<ros::message_traits::IsMessage<A>::value, ros::message_traits::IsMessage<B>::value>::convert(a, b);
}
template <class A>
void convert(const A& a, A& b) {
  b = a;
}

}  // namespace tf2
