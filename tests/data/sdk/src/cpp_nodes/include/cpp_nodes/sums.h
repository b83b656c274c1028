#pragma once

#include <cstdint>

int64_t sumOf(int64_t a, int64_t b);
