#pragma once

#include <filters/realtime_circular_buffer.hpp>
