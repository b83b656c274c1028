#pragma once

#include "ros/duration.h"
#include "ros/message_traits.h"
#include "ros/time.h"

namespace ros {
namespace message_traits {

#define ROS_SIMPLE_TYPE(Type)          \
  template <>                          \
  struct IsSimple<Type> : TrueType {}; \
  template <>                          \
  struct IsFixedSize<Type> : TrueType {}

ROS_SIMPLE_TYPE(uint8_t);
ROS_SIMPLE_TYPE(int8_t);
ROS_SIMPLE_TYPE(uint16_t);
ROS_SIMPLE_TYPE(int16_t);
ROS_SIMPLE_TYPE(uint32_t);
ROS_SIMPLE_TYPE(int32_t);
ROS_SIMPLE_TYPE(uint64_t);
ROS_SIMPLE_TYPE(int64_t);
ROS_SIMPLE_TYPE(float);
ROS_SIMPLE_TYPE(double);
ROS_SIMPLE_TYPE(Time);
ROS_SIMPLE_TYPE(Duration);
#undef ROS_SIMPLE_TYPE

/** bool is one byte on the wire, so its size is fixed; in memory it may be larger, so it is not simple. */
template <>
struct IsFixedSize<bool> : TrueType {};

}  // namespace message_traits
}  // namespace ros
