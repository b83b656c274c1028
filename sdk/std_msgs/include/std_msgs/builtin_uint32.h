#pragma once

#include <cstdint>

#include <std_msgs/UInt32.h>

#include "std_msgs/trait_macros.h"

STD_MSGS_DEFINE_BUILTIN_TRAITS(uint32_t, std_msgs::UInt32)
