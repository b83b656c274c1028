#include "freed_memory.h"

#include <algorithm>
#include <climits>
#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace trundle::messages {

#ifdef __GLIBC__

void keep_freed_memory(uint64_t bytes) {
  static uint64_t retained = 0;  // callers hold the GIL
  if (bytes <= retained) return;
  retained = bytes;
  constexpr int kLongestOnHeap = 32 * 1024 * 1024;  // M_MMAP_THRESHOLD's maximum (mallopt(3))
  mallopt(M_TRIM_THRESHOLD, static_cast<int>(std::min<uint64_t>(bytes, INT_MAX)));
  mallopt(M_MMAP_THRESHOLD, kLongestOnHeap);
}

#else

void keep_freed_memory(uint64_t) {}

#endif

}  // namespace trundle::messages
