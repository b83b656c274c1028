#pragma once

#include <string>

#include "ros/exception.h"

namespace ros {

#define ROS_EXCEPTION(Name)                                     \
  class Name : public Exception {                               \
   public:                                                      \
    explicit Name(const std::string& what) : Exception(what) {} \
  }
ROS_EXCEPTION(InvalidNodeNameException);
ROS_EXCEPTION(InvalidNameException);
ROS_EXCEPTION(ConflictingSubscriptionException);
ROS_EXCEPTION(InvalidParameterException);
ROS_EXCEPTION(InvalidPortException);
#undef ROS_EXCEPTION

}  // namespace ros
