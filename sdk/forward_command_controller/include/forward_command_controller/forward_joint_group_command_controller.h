#pragma once

#include <ros/node_handle.h>

#include <string>
#include <vector>

#include <controller_interface/controller.h>
#include <hardware_interface/joint_command_interface.h>
#include <realtime_tools/realtime_buffer.h>
#include <std_msgs/Float64MultiArray.h>

namespace forward_command_controller {

/** Forwards `command` (std_msgs/Float64MultiArray) to the joints of the parameter `joints`. T: interface of commands.
 */
template <class T>
class ForwardJointGroupCommandController : public controller_interface::Controller<T> {
 public:
  ForwardJointGroupCommandController() {}
  ~ForwardJointGroupCommandController() { sub_command_.shutdown(); }

  bool init(T* hw, ros::NodeHandle& n) {
    if (!n.getParam("joints", joint_names_) || joint_names_.empty()) {
      ROS_ERROR_STREAM("Failed to getParam 'joints' (namespace: " << n.getNamespace() << ").");
      return false;
    }
    n_joints_ = static_cast<unsigned int>(joint_names_.size());
    try {
      for (const std::string& name : joint_names_) joints_.push_back(hw->getHandle(name));
    } catch (const hardware_interface::HardwareInterfaceException& error) {
      ROS_ERROR_STREAM("Exception thrown: " << error.what());
      return false;
    }
    commands_buffer_.writeFromNonRT(std::vector<double>(n_joints_, 0.0));
    sub_command_ =
        n.subscribe<std_msgs::Float64MultiArray>("command", 1, &ForwardJointGroupCommandController::commandCB, this);
    return true;
  }
  void starting(const ros::Time& time);
  void update(const ros::Time&, const ros::Duration&) {
    const std::vector<double>& commands = *commands_buffer_.readFromRT();
    for (unsigned int i = 0; i < n_joints_; ++i) joints_[i].setCommand(commands[i]);
  }

  std::vector<std::string> joint_names_;
  std::vector<hardware_interface::JointHandle> joints_;
  realtime_tools::RealtimeBuffer<std::vector<double> > commands_buffer_;
  unsigned int n_joints_ = 0;

 private:
  void commandCB(const std_msgs::Float64MultiArrayConstPtr& msg) {
    if (msg->data.size() == n_joints_) {
      commands_buffer_.writeFromNonRT(msg->data);
      return;
    }
    ROS_ERROR_STREAM("Dimension of command (" << msg->data.size() << ") does not match number of joints (" << n_joints_
                                              << ")! Not executing!");
  }

  ros::Subscriber sub_command_;
};

}  // namespace forward_command_controller
