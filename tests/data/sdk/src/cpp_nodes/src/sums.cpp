#include "cpp_nodes/sums.h"

int64_t sumOf(int64_t a, int64_t b) { return static_cast<int64_t>(static_cast<uint64_t>(a) + static_cast<uint64_t>(b)); }
