#pragma once

#include <stdint.h>

#include <boost/array.hpp>
#include <boost/shared_ptr.hpp>
#include <string>

#include "ros/macros.h"
