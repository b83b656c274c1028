#include "time_slice.h"

#ifdef __linux__
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace trundle::messages {

#ifdef __linux__

namespace {

// The first version of the kernel's struct sched_attr (include/uapi/linux/sched/types.h), as libraries before
// glibc 2.41 have no name for it.
struct SchedAttr {
  uint32_t size, policy;
  uint64_t flags;
  int32_t nice;
  uint32_t priority;
  uint64_t runtime_ns, deadline_ns, period_ns;
};
constexpr uint64_t kResetOnFork = 1;  // SCHED_FLAG_RESET_ON_FORK; raises a negative nice value of children to 0

}  // namespace

void request_time_slice(uint64_t slice_ns) {
  SchedAttr attr{};
  if (syscall(SYS_sched_getattr, 0, &attr, sizeof attr, 0) != 0) return;
  if (attr.policy != SCHED_OTHER || attr.nice < 0) return;
  attr.flags |= kResetOnFork;
  attr.runtime_ns = slice_ns;
  static_cast<void>(syscall(SYS_sched_setattr, 0, &attr, 0));
}

#else

void request_time_slice(uint64_t) {}

#endif

}  // namespace trundle::messages
