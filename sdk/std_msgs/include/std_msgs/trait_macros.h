#pragma once

#include <ros/message_traits.h>

/** Lets a type of C++ be published as the message whose only field it is. */
#define STD_MSGS_DEFINE_BUILTIN_TRAITS(builtin, Message)                \
  namespace ros {                                                       \
  namespace message_traits {                                            \
  template <>                                                           \
  struct MD5Sum<builtin> {                                              \
    static const char* value() { return MD5Sum<Message>::value(); }     \
    static const char* value(const builtin&) { return value(); }        \
  };                                                                    \
  template <>                                                           \
  struct DataType<builtin> {                                            \
    static const char* value() { return DataType<Message>::value(); }   \
    static const char* value(const builtin&) { return value(); }        \
  };                                                                    \
  template <>                                                           \
  struct Definition<builtin> {                                          \
    static const char* value() { return Definition<Message>::value(); } \
    static const char* value(const builtin&) { return value(); }        \
  };                                                                    \
  }                                                                     \
  }
