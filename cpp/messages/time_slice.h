// The scheduler's time slice of a thread.
#pragma once

#include <cstdint>

namespace trundle::messages {

// Ask Linux for a slice of this length for the calling thread, not for those it starts: EEVDF runs a waking thread
// before one whose slice ends later. Nothing happens where the kernel knows no such request (before 6.12), or the
// thread has a policy or a priority of its user's.
void request_time_slice(uint64_t slice_ns);

}  // namespace trundle::messages
