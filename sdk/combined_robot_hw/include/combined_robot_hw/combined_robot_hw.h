#pragma once

#include <hardware_interface/robot_hw.h>
#include <pluginlib/class_loader.hpp>

#include <set>
#include <string>
#include <vector>

namespace combined_robot_hw {

/** Robot of the parts that the parameter robot_hardware lists, each a plugin named by its parameter NAME/type. */
class CombinedRobotHW : public hardware_interface::RobotHW {
 public:
  CombinedRobotHW() : robot_hw_loader_("hardware_interface", "hardware_interface::RobotHW") {}

  bool init(ros::NodeHandle& root_nh, ros::NodeHandle& robot_hw_nh) override {
    root_nh_ = root_nh;
    robot_hw_nh_ = robot_hw_nh;
    std::vector<std::string> names;
    if (!robot_hw_nh.getParam("robot_hardware", names)) {
      ROS_ERROR("there is no parameter %s, a list of robots", robot_hw_nh.resolveName("robot_hardware").c_str());
      return false;
    }
    for (const std::string& name : names)
      if (!loadRobotHW(name)) return false;
    return true;
  }
  bool prepareSwitch(const std::list<hardware_interface::ControllerInfo>& start_list,
                     const std::list<hardware_interface::ControllerInfo>& stop_list) override {
    for (const hardware_interface::RobotHWSharedPtr& part : robot_hw_list_)
      if (!part->prepareSwitch(controllersOf(*part, start_list), controllersOf(*part, stop_list))) return false;
    return true;
  }
  void doSwitch(const std::list<hardware_interface::ControllerInfo>& start_list,
                const std::list<hardware_interface::ControllerInfo>& stop_list) override {
    for (const hardware_interface::RobotHWSharedPtr& part : robot_hw_list_)
      part->doSwitch(controllersOf(*part, start_list), controllersOf(*part, stop_list));
  }
  void read(const ros::Time& time, const ros::Duration& period) override {
    for (const hardware_interface::RobotHWSharedPtr& part : robot_hw_list_) part->read(time, period);
  }
  void write(const ros::Time& time, const ros::Duration& period) override {
    for (const hardware_interface::RobotHWSharedPtr& part : robot_hw_list_) part->write(time, period);
  }

 protected:
  /** Create and prepare a part. */
  virtual bool loadRobotHW(const std::string& name) {
    ros::NodeHandle part_nh(robot_hw_nh_, name);
    std::string type;
    if (!part_nh.getParam("type", type)) {
      ROS_ERROR("there is no parameter %s, the class of a robot", part_nh.resolveName("type").c_str());
      return false;
    }
    try {
      const hardware_interface::RobotHWSharedPtr part = robot_hw_loader_.createSharedInstance(type);
      if (!part->init(root_nh_, part_nh)) {
        ROS_ERROR("robot '%s' of class %s cannot be used: its init failed", name.c_str(), type.c_str());
        return false;
      }
      robot_hw_list_.push_back(part);
      registerInterfaceManager(part.get());
      return true;
    } catch (const std::exception& error) {
      ROS_ERROR("robot '%s' of class %s cannot be used: %s", name.c_str(), type.c_str(), error.what());
      return false;
    }
  }

  ros::NodeHandle root_nh_, robot_hw_nh_;
  pluginlib::ClassLoader<hardware_interface::RobotHW> robot_hw_loader_;
  std::vector<hardware_interface::RobotHWSharedPtr> robot_hw_list_;

 private:
  typedef std::list<hardware_interface::ControllerInfo> Controllers;

  /** Controllers with those resources alone that a part has; without any claim they concern each part. */
  static Controllers controllersOf(const hardware_interface::RobotHW& part, const Controllers& all) {
    Controllers kept;
    for (const hardware_interface::ControllerInfo& controller : all) {
      hardware_interface::ControllerInfo own = controller;
      own.claimed_resources.clear();
      for (const hardware_interface::InterfaceResources& claimed : controller.claimed_resources) {
        hardware_interface::InterfaceResources has;
        has.hardware_interface = claimed.hardware_interface;
        for (const std::string& name : part.getInterfaceResources(claimed.hardware_interface))
          if (claimed.resources.count(name)) has.resources.insert(name);
        if (!has.resources.empty()) own.claimed_resources.push_back(has);
      }
      if (controller.claimed_resources.empty() || !own.claimed_resources.empty()) kept.push_back(own);
    }
    return kept;
  }
};

}  // namespace combined_robot_hw
