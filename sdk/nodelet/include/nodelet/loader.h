#pragma once

#include <ros/ros.h>

#include <map>
#include <string>
#include <vector>

#include "nodelet/nodelet.h"

namespace nodelet {

/** Nodelets of this process, by their names. */
class Loader {
 public:
  /** With `provide_ros_api`, services ~load_nodelet, ~unload_nodelet and ~list. */
  explicit Loader(bool provide_ros_api = true);
  explicit Loader(const ros::NodeHandle& server_nh);
  /** With a function that creates nodelets by their types, instead of plugins of packages. */
  explicit Loader(const boost::function<boost::shared_ptr<Nodelet>(const std::string& lookup_name)>& create_instance);
  ~Loader();

  /** Load a nodelet; false if its class cannot be created, or the name is taken. */
  bool load(const std::string& name, const std::string& type, const M_string& remappings, const V_string& my_argv);
  bool unload(const std::string& name);
  bool clear();
  std::vector<std::string> listLoadedNodelets();

 private:
  struct Impl;
  boost::shared_ptr<Impl> impl_;
};

}  // namespace nodelet
