#pragma once

#include <cstdint>

#include <std_msgs/Int16.h>

#include "std_msgs/trait_macros.h"

STD_MSGS_DEFINE_BUILTIN_TRAITS(int16_t, std_msgs::Int16)
