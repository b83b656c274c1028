#pragma once

#include <string>

#include <std_msgs/String.h>

#include "std_msgs/trait_macros.h"

STD_MSGS_DEFINE_BUILTIN_TRAITS(std::string, std_msgs::String)
