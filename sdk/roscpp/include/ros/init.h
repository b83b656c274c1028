#pragma once

#include "ros/common.h"
#include "ros/spinner.h"

namespace ros {

namespace init_options {
enum InitOption {
  /** Ctrl-C does not shut the node down. */
  NoSigintHandler = 1 << 0,
  /** The name gets a suffix that makes it unique. */
  AnonymousName = 1 << 1,
  /** Nothing is published on /rosout. */
  NoRosout = 1 << 2,
  NoSimTime = 1 << 3,
};
}
typedef init_options::InitOption InitOption;

/** Set the node's name and remappings; the remappings are removed from the command line. */
void init(int& argc, char** argv, const std::string& name, uint32_t options = 0);
void init(const M_string& remappings, const std::string& name, uint32_t options = 0);
void init(const VP_string& remapping_args, const std::string& name, uint32_t options = 0);
bool isInitialized();
bool isStarted();
bool isShuttingDown();
/** Register the node; the first NodeHandle calls this. */
void start();
void shutdown();
/** Shut down soon, from any thread or signal handler. */
void requestShutdown();
/** True until the node shuts down. */
bool ok();
/** Wait until the node shuts down. */
void waitForShutdown();
/** Call callbacks until the node shuts down. */
void spin();
void spin(Spinner& spinner);
/** Call the callbacks that are waiting. */
void spinOnce();
/** Queue of callbacks for which no other queue is set. */
CallbackQueue* getGlobalCallbackQueue();
void removeROSArgs(int argc, const char* const* argv, V_string& args_out);
std::string getROSArg(int argc, const char* const* argv, const std::string& arg);
const std::string& getDefaultMasterURI();

}  // namespace ros
