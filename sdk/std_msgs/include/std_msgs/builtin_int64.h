#pragma once

#include <cstdint>

#include <std_msgs/Int64.h>

#include "std_msgs/trait_macros.h"

STD_MSGS_DEFINE_BUILTIN_TRAITS(int64_t, std_msgs::Int64)
