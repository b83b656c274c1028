#pragma once

#include <ros/node_handle.h>

#include <string>

#include <controller_interface/controller.h>
#include <hardware_interface/joint_command_interface.h>
#include <realtime_tools/realtime_buffer.h>
#include <std_msgs/Float64.h>

namespace forward_command_controller {

/** Forwards `command` (std_msgs/Float64) to the joint of the parameter `joint`. T: interface of commands. */
template <class T>
class ForwardCommandController : public controller_interface::Controller<T> {
 public:
  ForwardCommandController() {}
  ~ForwardCommandController() { sub_command_.shutdown(); }

  bool init(T* hw, ros::NodeHandle& n) {
    std::string joint_name;
    if (!n.getParam("joint", joint_name)) {
      ROS_ERROR("No joint given (namespace: %s)", n.getNamespace().c_str());
      return false;
    }
    joint_ = hw->getHandle(joint_name);
    sub_command_ = n.subscribe<std_msgs::Float64>("command", 1, &ForwardCommandController::commandCB, this);
    return true;
  }
  void starting(const ros::Time& time);
  void update(const ros::Time&, const ros::Duration&) { joint_.setCommand(*command_buffer_.readFromRT()); }

  hardware_interface::JointHandle joint_;
  realtime_tools::RealtimeBuffer<double> command_buffer_;

 private:
  void commandCB(const std_msgs::Float64ConstPtr& msg) { command_buffer_.writeFromNonRT(msg->data); }

  ros::Subscriber sub_command_;
};

}  // namespace forward_command_controller
