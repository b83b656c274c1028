#pragma once

#include <ros/node_handle.h>

#include <condition_variable>
#include <list>
#include <mutex>
#include <string>
#include <vector>

#include <controller_interface/controller_base.h>
#include <controller_manager/controller_loader.h>
#include <controller_manager/controller_loader_interface.h>
#include <controller_manager/controller_spec.h>
#include <controller_manager_msgs/ListControllerTypes.h>
#include <controller_manager_msgs/ListControllers.h>
#include <controller_manager_msgs/LoadController.h>
#include <controller_manager_msgs/ReloadControllerLibraries.h>
#include <controller_manager_msgs/SwitchController.h>
#include <controller_manager_msgs/UnloadController.h>
#include <hardware_interface/robot_hw.h>

namespace controller_manager {

/** Loads, switches and updates the controllers of a robot; services in `controller_manager` do so, too. `update` is
    called by the robot's loop, all else by other threads. */
class ControllerManager {
 public:
  explicit ControllerManager(hardware_interface::RobotHW* robot_hw, const ros::NodeHandle& nh = ros::NodeHandle());
  virtual ~ControllerManager();
  ControllerManager(const ControllerManager&) = delete;
  ControllerManager& operator=(const ControllerManager&) = delete;

  /** Update the running controllers, and begin a switch that waits; `reset_controllers`: restart them first. */
  void update(const ros::Time& time, const ros::Duration& period, bool reset_controllers = false);

  /** Load a controller, by the parameters `NAME/type` and others of the namespace. */
  bool loadController(const std::string& name);
  /** Unload one that does not run. */
  bool unloadController(const std::string& name);
  /** Stop and start controllers between two updates. With `STRICT`, all or none; 0 is STRICT, too.
      `start_asap`: each as soon as its hardware is ready; `timeout` [s], 0: none. */
  bool switchController(const std::vector<std::string>& start_controllers,
                        const std::vector<std::string>& stop_controllers, const int strictness, bool start_asap = false,
                        double timeout = 0.0);

  /** Controller by name; null if it is not loaded. */
  virtual controller_interface::ControllerBase* getControllerByName(const std::string& name);
  void getControllerNames(std::vector<std::string>& names);
  /** Types of a loader come after those of the loaders before it. */
  void registerControllerLoader(ControllerLoaderInterfaceSharedPtr controller_loader);

 private:
  struct Switch {
    std::vector<ControllerSpec> stop, start;
    std::list<hardware_interface::ControllerInfo> stop_infos, start_infos;
    bool is_pending = false, is_begun = false, start_asap = false;
    double timeout = 0.0;
    ros::Time begin;
  };

  bool listControllers(controller_manager_msgs::ListControllers::Request&,
                       controller_manager_msgs::ListControllers::Response&);
  bool listTypes(controller_manager_msgs::ListControllerTypes::Request&,
                 controller_manager_msgs::ListControllerTypes::Response&);
  bool load(controller_manager_msgs::LoadController::Request&, controller_manager_msgs::LoadController::Response&);
  bool unload(controller_manager_msgs::UnloadController::Request&,
              controller_manager_msgs::UnloadController::Response&);
  bool change(controller_manager_msgs::SwitchController::Request&,
              controller_manager_msgs::SwitchController::Response&);
  bool reload(controller_manager_msgs::ReloadControllerLibraries::Request&,
              controller_manager_msgs::ReloadControllerLibraries::Response&);
  bool collect(const std::vector<std::string>& names, bool starts, bool is_strict, std::vector<ControllerSpec>& out);
  const ControllerSpec* find(const std::string& name) const;
  void proceed(const ros::Time& time);
  bool isReady(const ControllerSpec& spec) const;

  hardware_interface::RobotHW* robot_hw_;
  ros::NodeHandle root_nh_, cm_node_;
  std::vector<ControllerLoaderInterfaceSharedPtr> loaders_;
  /** Held while controllers are loaded, unloaded or switched; `list_mutex_` while the list is changed or used. */
  std::mutex services_mutex_;
  std::recursive_mutex list_mutex_;
  std::condition_variable_any switched_;
  std::vector<ControllerSpec> controllers_;
  Switch switch_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace controller_manager
