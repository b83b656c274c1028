#pragma once

#include <csignal>
#include <cstdlib>

#include "ros/console.h"

#define ROS_ISSUE_BREAK() std::raise(SIGTRAP);

#ifndef NDEBUG
#define ROS_ASSERT_ENABLED
#endif

#ifdef ROS_ASSERT_ENABLED
#define ROS_BREAK()                                                            \
  do {                                                                         \
    ROS_FATAL("BREAKPOINT HIT\n\tfile = %s\n\tline=%d\n", __FILE__, __LINE__); \
    ROS_ISSUE_BREAK()                                                          \
  } while (false)
#define ROS_ASSERT(cond)                                                                                 \
  do {                                                                                                   \
    if (!(cond)) {                                                                                       \
      ROS_FATAL("ASSERTION FAILED\n\tfile = %s\n\tline = %d\n\tcond = %s\n", __FILE__, __LINE__, #cond); \
      ROS_ISSUE_BREAK()                                                                                  \
    }                                                                                                    \
  } while (false)
#define ROS_ASSERT_MSG(cond, ...)                                                                                    \
  do {                                                                                                               \
    if (!(cond)) {                                                                                                   \
      ROS_FATAL("ASSERTION FAILED\n\tfile = %s\n\tline = %d\n\tcond = %s\n\tmessage = ", __FILE__, __LINE__, #cond); \
      ROS_FATAL(__VA_ARGS__);                                                                                        \
      ROS_ISSUE_BREAK()                                                                                              \
    }                                                                                                                \
  } while (false)
#define ROS_ASSERT_CMD(cond, command) \
  do {                                \
    if (!(cond)) {                    \
      command;                        \
    }                                 \
  } while (false)
#else
#define ROS_BREAK() static_cast<void>(0)
#define ROS_ASSERT(cond) static_cast<void>(0)
#define ROS_ASSERT_MSG(cond, ...) static_cast<void>(0)
#define ROS_ASSERT_CMD(cond, command) static_cast<void>(0)
#endif
