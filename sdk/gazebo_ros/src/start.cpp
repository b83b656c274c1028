// Makes the simulator's process a node, as gazebo_ros does before it loads plugins.
#include <map>
#include <string>

#include <ros/ros.h>

// Called by the simulator, on its thread.
extern "C" void trundle_gazebo_start_ros(const char* master_uri, const char* node) {
  if (ros::isInitialized()) return;
  std::map<std::string, std::string> remappings;
  remappings["__master"] = master_uri;
  ros::init(remappings, node, ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
  // Callbacks of handles without a queue of their own, as in gazebo_ros; both live as long as the process.
  new ros::NodeHandle;
  (new ros::AsyncSpinner(0))->start();
}
