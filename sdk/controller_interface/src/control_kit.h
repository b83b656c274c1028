// Robots that the simulator's controllers act on.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <controller_interface/trundle_control.h>
#include <hardware_interface/robot_hw.h>

namespace trundle {

struct Robot {
  std::shared_ptr<hardware_interface::RobotHW> hardware;
  std::function<void(const ros::Time&, const ros::Duration&)> read, write;
  std::function<void(bool)> stop;  // emergency stop
};

}  // namespace trundle

// Give a model a robot that gazebo_ros_control has made, in place of an earlier one; "": take it away.
extern "C" void trundle_control_set_robot(const char* model, std::shared_ptr<trundle::Robot>* robot);
