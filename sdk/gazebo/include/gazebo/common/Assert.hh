#ifndef GAZEBO_COMMON_ASSERT_HH_
#define GAZEBO_COMMON_ASSERT_HH_

#include <gazebo/common/Exception.hh>

// A failed assertion ends the plugin's call with an exception.
#define GZ_ASSERT(expression, text)                                                                                 \
  do {                                                                                                              \
    if (!(expression))                                                                                              \
      throw ::gazebo::common::AssertionInternalError(__FILE__, __LINE__, #expression, __func__, std::string(text)); \
  } while (false)

#endif
