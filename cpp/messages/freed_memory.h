// Memory of the process that is freed and soon needed again.
#pragma once

#include <cstdint>

namespace trundle::messages {

// Let the process keep freed memory for its next allocations: up to a number of bytes at the end of each heap, the
// largest of all calls. glibc otherwise returns a long message to the kernel when it is freed, and the next one meets a
// page fault every 4 KiB. No effect with other C libraries.
void keep_freed_memory(uint64_t bytes);

}  // namespace trundle::messages
