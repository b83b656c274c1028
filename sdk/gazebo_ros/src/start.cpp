// Makes the simulator's process a node, as gazebo_ros does before it loads plugins.
#include <chrono>
#include <map>
#include <string>
#include <thread>

#include <ros/ros.h>

namespace {

// Callbacks of handles without a queue of their own, as in gazebo_ros; both live until the node ends.
ros::NodeHandle* handle = nullptr;
ros::AsyncSpinner* spinner = nullptr;

constexpr std::chrono::milliseconds kPatience(100);

}  // namespace

// Called by the simulator, on its thread; so is the next one.
extern "C" void trundle_gazebo_start_ros(const char* master_uri, const char* node) {
  if (ros::isInitialized() && ros::ok()) return;
  std::map<std::string, std::string> remappings;
  remappings["__master"] = master_uri;
  ros::init(remappings, node, ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
  handle = new ros::NodeHandle;
  spinner = new ros::AsyncSpinner(0);
  spinner->start();
}

// Ends the node before the plugins end. Their threads ask `ok()` of a handle every 10 ms or so, and many a plugin
// deletes the handle before it waits for its thread: by then the thread has ended, as where gazebo_ros hears of Ctrl-C.
extern "C" void trundle_gazebo_stop_ros() {
  if (!handle) return;
  ros::shutdown();
  spinner->stop();
  delete spinner;
  delete handle;
  spinner = nullptr;
  handle = nullptr;
  std::this_thread::sleep_for(kPatience);
}
