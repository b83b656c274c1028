// The scheduler's time slice of a thread.
#pragma once

#include <cstdint>

namespace trundle::messages {

// Ask Linux for a slice of this length for the calling thread, not for those it starts: EEVDF runs a waking thread
// before one whose slice ends later. No effect if the kernel does not support it (before 6.12), or if the thread has a
// policy or a priority set by its user.
void request_time_slice(uint64_t slice_ns);

}  // namespace trundle::messages
