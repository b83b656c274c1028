#include "ros/init.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdlib>

#include "node.h"
#include "ros/callback_queue.h"
#include "ros/names.h"
#include "ros/network.h"
#include "ros/param.h"
#include "ros/this_node.h"
#include "server.h"
#include "services.h"
#include "socket.h"
#include "topics.h"

#include <fcntl.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

namespace ros {
namespace {

struct State {
  std::mutex starting;  // held while the node starts or shuts down
  std::mutex mutex;
  std::condition_variable changed;
  std::atomic<bool> is_initialized{false}, is_started{false}, is_shutting_down{false}, is_ok{true};
  uint32_t options = 0;
  CallbackQueue queue;
  struct Worker {
    std::thread thread;
    std::shared_ptr<std::atomic<bool>> is_done;
  };
  std::vector<Worker> workers;
  int shutdown_pipe[2] = {-1, -1};
};

State& state() {
  static State* const instance = new State;
  return *instance;
}

void requestByPipe() {
  const char byte = 0;
  if (state().shutdown_pipe[1] >= 0) (void)!::write(state().shutdown_pipe[1], &byte, 1);
}

void onInterrupt(int) { requestByPipe(); }

/** Thread that shuts the node down on request, which a signal handler cannot do itself. */
void watchRequests() {
  State& s = state();
  if (s.shutdown_pipe[0] >= 0 || pipe(s.shutdown_pipe) != 0) return;
  for (const int end : s.shutdown_pipe) fcntl(end, F_SETFD, FD_CLOEXEC);
  fcntl(s.shutdown_pipe[1], F_SETFL, O_NONBLOCK);
  std::thread([&s] {
    char byte = 0;
    while (true)
      if (::read(s.shutdown_pipe[0], &byte, 1) == 1) ros::shutdown();
  }).detach();
}

void shutdownAtExit() {
  if (state().is_started) ros::shutdown();
}

}  // namespace

namespace node {

void runInThread(std::function<void()> function) {
  State& s = state();
  std::vector<State::Worker> done;
  const std::lock_guard<std::mutex> lock(s.mutex);
  if (s.is_shutting_down) return;
  for (auto worker = s.workers.begin(); worker != s.workers.end();)
    if (*worker->is_done) {
      worker->thread.join();
      worker = s.workers.erase(worker);
    } else {
      ++worker;
    }
  const auto is_done = std::make_shared<std::atomic<bool>>(false);
  s.workers.push_back({std::thread([function, is_done] {
                         function();
                         *is_done = true;
                       }),
                       is_done});
}

bool waitMs(int duration) {
  State& s = state();
  std::unique_lock<std::mutex> lock(s.mutex);
  s.changed.wait_for(lock, std::chrono::milliseconds(duration), [&s] { return s.is_shutting_down.load(); });
  return !s.is_shutting_down;
}

}  // namespace node

void init(const M_string& remappings, const std::string& name, uint32_t options) {
  State& s = state();
  if (!s.is_initialized) {
    std::atexit(shutdownAtExit);
    std::signal(SIGPIPE, SIG_IGN);
    console::initialize();
    s.options = options;
    watchRequests();
    if (!(options & init_options::NoSigintHandler)) {
      struct sigaction action = {};
      action.sa_handler = onInterrupt;
      sigaction(SIGINT, &action, nullptr);
    }
    master::init(remappings);
    network::init(remappings);
    this_node::init(name, remappings, options);
    s.is_initialized = true;
    param::init(remappings);
  } else if (!s.is_started) {  // a second life, after shutdown()
    s.is_shutting_down = false;
    s.is_ok = true;
  }
}

void init(int& argc, char** argv, const std::string& name, uint32_t options) {
  M_string remappings;
  std::vector<char*> kept, taken;
  for (int i = 0; i < argc; ++i) {
    const std::string argument = argv[i];
    const size_t at = argument.find(":=");
    if (at == std::string::npos) {
      kept.push_back(argv[i]);
      continue;
    }
    taken.push_back(argv[i]);
    remappings[argument.substr(0, at)] = argument.substr(at + 2);
  }
  const size_t count = kept.size();
  kept.insert(kept.end(), taken.begin(), taken.end());
  std::copy(kept.begin(), kept.end(), argv);
  argc = static_cast<int>(count);
  init(remappings, name, options);
}

void init(const VP_string& remapping_args, const std::string& name, uint32_t options) {
  init(M_string(remapping_args.begin(), remapping_args.end()), name, options);
}

void removeROSArgs(int argc, const char* const* argv, V_string& args_out) {
  for (int i = 0; i < argc; ++i)
    if (std::string(argv[i]).find(":=") == std::string::npos) args_out.push_back(argv[i]);
}

std::string getROSArg(int argc, const char* const* argv, const std::string& arg) {
  for (int i = 0; i < argc; ++i) {
    const std::string argument = argv[i];
    const size_t at = argument.find(":=");
    if (at != std::string::npos && argument.substr(0, at) == arg) return argument.substr(at + 2);
  }
  return "";
}

bool isInitialized() { return state().is_initialized; }
bool isStarted() { return state().is_started; }
bool isShuttingDown() { return state().is_shutting_down; }
bool ok() { return state().is_ok; }
CallbackQueue* getGlobalCallbackQueue() { return &state().queue; }

void start() {
  State& s = state();
  const std::lock_guard<std::mutex> starting(s.starting);
  if (s.is_started) return;
  s.is_shutting_down = false;
  s.is_ok = true;
  s.is_started = true;
  s.queue.enable();
  net::allowWaiting();
  Time::init();
  server::start();
  bool is_simulated = false;
  if (!(s.options & init_options::NoSimTime)) param::get("/use_sim_time", is_simulated);
  if (is_simulated) Time::setNow(Time());
  if (!(s.options & init_options::NoRosout)) rosout::start();
  rosout::serveLoggers();
  if (is_simulated) server::followClock();
  if (s.is_shutting_down) return;
  ROS_DEBUG("Started node [%s], pid [%d], bound on [%s], xmlrpc [%s], tcpros port [%d], using [%s] time",
            this_node::getName().c_str(), getpid(), network::getHost().c_str(), node::uri().c_str(),
            network::getTCPROSPort(), Time::useSystemTime() ? "real" : "sim");
}

void requestShutdown() { requestByPipe(); }

void shutdown() {
  State& s = state();
  {
    // Ends a start() that waits for the master.
    const std::lock_guard<std::mutex> lock(s.mutex);
    if (!s.is_started && !s.is_initialized) return;
    s.is_shutting_down = true;
    s.is_ok = false;
  }
  s.changed.notify_all();
  const std::lock_guard<std::mutex> starting(s.starting);
  if (!s.is_started) {
    Time::init();  // the program may still call Time::now()
    Time::shutdown();
    return;
  }
  net::abortWaiting(1000);  // the node does not wait longer for a silent master
  s.queue.disable();
  s.queue.clear();
  Time::shutdown();
  timers::stop();
  rosout::stop();
  topics::shutdown();
  services::shutdown();
  net::abortWaiting(0);
  server::stop();
  std::vector<State::Worker> workers;
  {
    const std::lock_guard<std::mutex> lock(s.mutex);
    workers.swap(s.workers);
  }
  for (State::Worker& worker : workers) worker.thread.join();
  s.is_started = false;
  s.changed.notify_all();
}

void waitForShutdown() {
  State& s = state();
  std::unique_lock<std::mutex> lock(s.mutex);
  s.changed.wait(lock, [&s] { return !s.is_ok; });
}

void spin() {
  SingleThreadedSpinner spinner;
  spin(spinner);
}
void spin(Spinner& spinner) { spinner.spin(); }
void spinOnce() { getGlobalCallbackQueue()->callAvailable(); }

}  // namespace ros
