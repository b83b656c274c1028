#pragma once

#include <cstdint>

#include <std_msgs/Int32.h>

#include "std_msgs/trait_macros.h"

STD_MSGS_DEFINE_BUILTIN_TRAITS(int32_t, std_msgs::Int32)
