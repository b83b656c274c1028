// Reads and sets the parameters of the node drive.
#include <cpp_config/DriveConfig.h>
#include <dynamic_reconfigure/client.h>
#include <ros/ros.h>

#include <iostream>
#include <sstream>

typedef dynamic_reconfigure::Client<cpp_config::DriveConfig> Client;

void print(const std::string& name, const cpp_config::DriveConfig& config) {
  std::ostringstream line;  // written at once, as callbacks run in another thread
  line << name << " turns " << config.turns << " depth " << config.depth << " gain " << config.gain << '\n';
  std::cout << line.str() << std::flush;
}

int main(int argc, char** argv) {
  ros::init(argc, argv, "steer");
  ros::AsyncSpinner spinner(1);
  Client client("/drive", [](const cpp_config::DriveConfig& config) { print("callback", config); });
  spinner.start();
  cpp_config::DriveConfig config, bound;
  if (!client.getCurrentConfiguration(config, ros::Duration(30))) return 1;
  config.turns = 3;
  config.depth = 7;
  if (!client.setConfiguration(config)) return 2;
  print("set", config);
  if (!client.getCurrentConfiguration(bound) || bound.turns != 3 || bound.depth != -1) return 4;
  if (!client.getMinConfiguration(bound, ros::Duration(30))) return 3;
  print("min", bound);
  Client none("/no_such_node");
  std::cout << none.getCurrentConfiguration(config, ros::Duration(0.1)) << none.setConfiguration(config) << std::endl;
  return 0;
}
