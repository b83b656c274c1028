#include "crash_report.h"

#include <csignal>
#include <cstring>
#include <iterator>

#ifndef _WIN32
#include <unistd.h>
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
      print(*hint ? "; before that it looked for a parameter that is missing: " : "");
      print(hint);
      print("; compiled with -DCMAKE_BUILD_TYPE=Debug, a debugger shows the line\n");
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
