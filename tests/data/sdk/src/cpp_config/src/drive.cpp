// A node with parameters that may be changed; it tells each change.
#include <cpp_config/DriveConfig.h>
#include <dynamic_reconfigure/server.h>
#include <ros/ros.h>
#include <std_msgs/String.h>

#include <sstream>

ros::Publisher told;

void callback(cpp_config::DriveConfig& config, uint32_t level) {
  std_msgs::String message;
  std::stringstream text;
  text << "level " << level << " mode " << config.mode << " gain " << config.gain << " frame " << config.frame
       << " is_on " << config.is_on << " speed " << config.speed << " turns " << config.turns << " depth "
       << config.depth << " open " << config.groups.state << config.groups.limits_of_it.state
       << config.groups.limits_of_it.inner.state;
  message.data = text.str();
  told.publish(message);
  if (config.mode == cpp_config::Drive_Fast) config.gain = 9.0;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "drive");
  ros::NodeHandle node;
  told = node.advertise<std_msgs::String>("told", 10, true);
  dynamic_reconfigure::Server<cpp_config::DriveConfig> server;
  dynamic_reconfigure::Server<cpp_config::DriveConfig>::CallbackType f = boost::bind(&callback, _1, _2);
  server.setCallback(f);
  boost::recursive_mutex mutex;
  dynamic_reconfigure::Server<cpp_config::DriveConfig> other(mutex, ros::NodeHandle("~/other"));
  cpp_config::DriveConfig config = cpp_config::DriveConfig::__getDefault__();
  config.turns = 12;
  other.updateConfig(config);
  ros::spin();
  return 0;
}
