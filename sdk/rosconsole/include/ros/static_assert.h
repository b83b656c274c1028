#pragma once

#define ROS_COMPILE_ASSERT(cond) static_assert(cond, #cond)
#define ROS_STATIC_ASSERT(cond) static_assert(cond, #cond)
