// nodelet manager|load|standalone|unload: a process of nodelets, and those who ask it to load them.
#include <bondcpp/bond.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <nodelet/loader.h>
#include <ros/ros.h>

#include <algorithm>
#include <csignal>
#include <iostream>

namespace {

volatile std::sig_atomic_t is_interrupted = 0;

int usage() {
  std::cerr << "usage: nodelet load CLASS MANAGER [--no-bond] [ARGUMENT...]  load a nodelet into a manager\n"
               "       nodelet standalone CLASS [ARGUMENT...]              run a nodelet in a process of its own\n"
               "       nodelet unload NAME MANAGER                         unload a nodelet\n"
               "       nodelet manager                                     run a manager\n";
  return 1;
}

std::string defaultName(std::string type) {
  std::replace(type.begin(), type.end(), '/', '_');
  std::replace(type.begin(), type.end(), ':', '_');
  return type;
}

bool unload(const std::string& name, const std::string& manager) {
  ros::NodeHandle node;
  ros::ServiceClient client = node.serviceClient<nodelet::NodeletUnload>(manager + "/unload_nodelet");
  nodelet::NodeletUnload service;
  service.request.name = name;
  if (client.call(service) && service.response.success) return true;
  ROS_WARN("Couldn't find service %s/unload_nodelet, perhaps the manager is already shut down", manager.c_str());
  return false;
}

/** Ask a manager to load a nodelet, and stay until this program or the manager ends. */
int load(const std::string& type, const std::string& manager_name, const nodelet::V_string& arguments, bool is_bound) {
  ros::NodeHandle node;
  const std::string name = ros::this_node::getName(), manager = node.resolveName(manager_name);
  nodelet::NodeletLoad service;
  service.request.name = name;
  service.request.type = type;
  service.request.my_argv = arguments;
  for (const auto& pair : ros::names::getRemappings()) {
    service.request.remap_source_args.push_back(pair.first);
    service.request.remap_target_args.push_back(pair.second);
  }
  if (is_bound) service.request.bond_id = name + "_" + std::to_string(ros::WallTime::now().toNSec());
  ROS_DEBUG("Loading nodelet %s of type %s to manager %s", name.c_str(), type.c_str(), manager.c_str());
  ros::ServiceClient client = node.serviceClient<nodelet::NodeletLoad>(manager + "/load_nodelet");
  while (!client.waitForExistence(ros::Duration(0.5)))
    if (is_interrupted || !ros::ok()) return 1;
  if (!client.call(service) || !service.response.success) {
    ROS_FATAL("Failed to load nodelet '%s' of type '%s' to manager '%s'", name.c_str(), type.c_str(), manager.c_str());
    return 1;
  }
  bond::Bond bond(manager + "/bond", service.request.bond_id);
  if (is_bound) bond.start();
  while (!is_interrupted && ros::ok() && !(is_bound && bond.isBroken())) {
    ros::spinOnce();
    ros::WallDuration(0.05).sleep();
  }
  const bool is_manager_gone = is_bound && bond.isBroken();
  if (is_manager_gone) ROS_INFO("Bond broken, exiting");
  else unload(name, manager);
  ros::shutdown();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  nodelet::V_string words;
  ros::removeROSArgs(argc, argv, words);
  nodelet::V_string arguments(words.size() > 1 ? words.begin() + 1 : words.end(), words.end());
  const auto bond_flag = std::find(arguments.begin(), arguments.end(), "--no-bond");
  const bool is_bound = bond_flag == arguments.end();
  if (!is_bound) arguments.erase(bond_flag);
  const std::string command = arguments.empty() ? "" : arguments[0];
  if (command == "manager") {
    ros::init(argc, argv, "manager");
    nodelet::Loader loader;
    ros::spin();
    return 0;
  }
  if (command == "standalone" && arguments.size() >= 2) {
    ros::init(argc, argv, defaultName(arguments[1]));
    ros::NodeHandle node;
    nodelet::Loader loader(false);
    const nodelet::V_string rest(arguments.begin() + 2, arguments.end());
    if (!loader.load(ros::this_node::getName(), arguments[1], ros::names::getRemappings(), rest)) return 1;
    ros::spin();
    return 0;
  }
  if (command == "load" && arguments.size() >= 3) {
    ros::init(argc, argv, defaultName(arguments[1]), ros::init_options::NoSigintHandler);
    for (const int number : {SIGINT, SIGTERM}) std::signal(number, [](int) { is_interrupted = 1; });
    return load(arguments[1], arguments[2], nodelet::V_string(arguments.begin() + 3, arguments.end()), is_bound);
  }
  if (command == "unload" && arguments.size() >= 3) {
    ros::init(argc, argv, "nodelet_unload", ros::init_options::AnonymousName);
    ros::NodeHandle node;
    return unload(node.resolveName(arguments[1]), node.resolveName(arguments[2])) ? 0 : 1;
  }
  return usage();
}
