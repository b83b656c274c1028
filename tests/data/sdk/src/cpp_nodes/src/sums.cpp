#include "cpp_nodes/sums.h"

int64_t sumOf(int64_t a, int64_t b) { return a + b; }
