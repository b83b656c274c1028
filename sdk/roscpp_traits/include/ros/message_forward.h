#pragma once

#include <cstddef>
#include <memory>

#define ROS_DECLARE_MESSAGE_WITH_ALLOCATOR(msg, new_name, alloc) \
  template <class Allocator>                                     \
  struct msg##_;                                                 \
  typedef msg##_<alloc<void> > new_name;                         \
  typedef boost::shared_ptr<new_name> new_name##Ptr;             \
  typedef boost::shared_ptr<new_name const> new_name##ConstPtr;

#define ROS_DECLARE_MESSAGE(msg) ROS_DECLARE_MESSAGE_WITH_ALLOCATOR(msg, msg, std::allocator)

namespace boost {
template <class T>
class shared_ptr;
}
