// Run-time choice of the widest kernel that the processor supports.
#include <cstdlib>
#include <string_view>
#ifdef TRUNDLE_X86
#include <cpuid.h>
#endif

#include "kernel.h"

namespace trundle {

#ifdef TRUNDLE_X86
namespace {

struct Processor {
  bool avx2 = false, avx512 = false;

  // CPUID directly: not every compiler's runtime has __builtin_cpu_supports. XGETBV: the system must save the
  // registers.
  Processor() {
    unsigned a, b, c, d;
    if (!__get_cpuid(1, &a, &b, &c, &d) || (c & (1u << 27)) == 0) return;
    unsigned saved, high;
    asm volatile("xgetbv" : "=a"(saved), "=d"(high) : "c"(0));
    if (!__get_cpuid_count(7, 0, &a, &b, &c, &d)) return;
    constexpr unsigned kF = 1u << 16, kDq = 1u << 17, kBw = 1u << 30, kVl = 1u << 31, kFull = kF | kDq | kBw | kVl;
    avx2 = (saved & 0x06) == 0x06 && (b & (1u << 5)) != 0;
    avx512 = avx2 && (saved & 0xe6) == 0xe6 && (b & kFull) == kFull;
  }
};

}  // namespace
#endif

const Kernel& best_kernel() {
  static const Kernel& chosen = []() -> const Kernel& {
#ifdef TRUNDLE_X86
    const char* requested = std::getenv("TRUNDLE_RENDER_ISA");  // for comparison of their images
    const std::string_view widest = requested ? requested : "avx512";
    const Processor processor;
    if (widest == "avx512" && processor.avx512) return avx512::kernel;
    if (widest != "baseline" && processor.avx2) return avx2::kernel;
#endif
    return baseline::kernel;
  }();
  return chosen;
}

}  // namespace trundle
