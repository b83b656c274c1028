#include "crash_report.h"

#include <csignal>
#include <cstring>
#include <iterator>

#ifndef _WIN32
#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#endif

namespace trundle {

namespace {

thread_local const char* running_plugin = nullptr;
const TrundleGazeboKit* hinting = nullptr;

#ifndef _WIN32

constexpr int kSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr const char* kNames[] = {"SIGSEGV", "SIGBUS", "SIGFPE", "SIGILL", "SIGABRT"};
struct sigaction before[std::size(kSignals)];

void print(const char* text) { [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, std::strlen(text)); }

constexpr int kMostFrames = 64, kPrinted = 4;
constexpr const char* kSystem[] = {"libc.so", "libc-", "libstdc++", "libgcc_s", "libpthread", "libm.so", "ld-linux"};

void print_hex(std::uintptr_t value) {
  char text[2 * sizeof(value) + 3];
  char* next = text + sizeof(text) - 1;
  *next = 0;
  do *--next = "0123456789abcdef"[value & 15];
  while (value >>= 4);
  *--next = 'x';
  *--next = '0';
  print(next);
}

bool is_system(const Dl_info& where) {
  for (const char* name : kSystem)
    if (std::strstr(where.dli_fname, name)) return true;
  return false;
}

// Function and library of the innermost calls: of the plugin's, and of those of the kit that it called.
void print_frames(void (*handler)(int)) {
  void* frames[kMostFrames];
  Dl_info own, where;
  if (!::dladdr(reinterpret_cast<void*>(handler), &own)) return;
  const int count = ::backtrace(frames, kMostFrames);
  int in_system = 0;  // calls there, of which the first is the signal's
  for (int i = 0, printed = 0; i < count && printed < kPrinted; ++i) {
    if (!::dladdr(frames[i], &where) || !where.dli_fname) continue;
    if (where.dli_fbase == own.dli_fbase) {
      if (printed) return;  // what called the plugin
      continue;
    }
    if (is_system(where)) {
      ++in_system;
      continue;
    }
    // Memory may be broken where the fault is in the library of C, and demangling needs some.
    char* name =
        where.dli_sname && in_system < 2 ? abi::__cxa_demangle(where.dli_sname, nullptr, nullptr, nullptr) : nullptr;
    print("  in ");
    if (where.dli_sname) print(name ? name : where.dli_sname);
    else print_hex(reinterpret_cast<std::uintptr_t>(frames[i]) - reinterpret_cast<std::uintptr_t>(where.dli_fbase));
    print(" of ");
    print(where.dli_fname);
    print("\n");
    ++printed;
  }
}

// The instruction is repeated after the return, with the signal's former action.
void on_fault(int signal) {
  for (std::size_t i = 0; i < std::size(kSignals); ++i) {
    if (kSignals[i] != signal) continue;
    if (running_plugin) {
      print("\ntrundle: error: plugin '");
      print(running_plugin);
      print("' crashed in its C++ code (");
      print(kNames[i]);
      print(")");
      const char* hint = hinting ? hinting->hint() : "";
      print(*hint ? "; before that " : "");
      print(hint);
      print("; compiled with -DCMAKE_BUILD_TYPE=Debug, a debugger shows the line\n");
      print_frames(on_fault);
    }
    ::sigaction(signal, &before[i], nullptr);
    if (signal == SIGABRT) ::raise(signal);
  }
}

#endif

}  // namespace

void install_crash_report() {
#ifndef _WIN32
  static bool is_installed = false;
  if (is_installed) return;
  is_installed = true;
  void* frame[1];
  ::backtrace(frame, 1);  // loads the library that it needs, which a crashing process cannot
  struct sigaction action;
  std::memset(&action, 0, sizeof(action));
  action.sa_handler = on_fault;
  action.sa_flags = SA_NODEFER | SA_ONSTACK;
  for (std::size_t i = 0; i < std::size(kSignals); ++i) ::sigaction(kSignals[i], &action, &before[i]);
#endif
}

void set_running_plugin(const char* plugin) { running_plugin = plugin; }
void set_crash_hint(const TrundleGazeboKit* kit) { hinting = kit; }

}  // namespace trundle
