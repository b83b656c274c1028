// The command `trundle` on Linux and macOS: starts Python with SIGINT blocked.
//
// Python handles SIGINT with a traceback until the first line of a program runs. This program blocks the signal and
// executes `_trundle` next to it, the script that the installer wrote for its Python; trundle.__main__ unblocks the
// signal as soon as it can be handled (decision 0010).

#include <unistd.h>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#ifdef __APPLE__
#include <mach-o/dyld.h>
#endif

namespace {

// Path of this program, symbolic links resolved.
bool own_path(char (&path)[PATH_MAX]) {
#ifdef __APPLE__
  char link[PATH_MAX];
  std::uint32_t size = sizeof link;
  return _NSGetExecutablePath(link, &size) == 0 && realpath(link, path) != nullptr;
#else
  return realpath("/proc/self/exe", path) != nullptr;
#endif
}

}  // namespace

int main(int, char** arguments) {
  sigset_t held;
  sigemptyset(&held);
  sigaddset(&held, SIGINT);
  sigprocmask(SIG_BLOCK, &held, nullptr);
  char script[PATH_MAX];
  const char* const name = "/_trundle";
  if (!own_path(script)) {
    std::perror("trundle: where is this program?");
    return 1;
  }
  char* const end = std::strrchr(script, '/');
  if (static_cast<std::size_t>(end - script) + std::strlen(name) >= sizeof script) {
    std::fprintf(stderr, "trundle: the path of this program is too long: %s\n", script);
    return 1;
  }
  std::memcpy(end, name, std::strlen(name) + 1);
  execv(script, arguments);
  std::fprintf(stderr, "%s: %s; install Trundle again\n", script, std::strerror(errno));
  return 1;
}
