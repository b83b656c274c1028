#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include <hardware_interface/robot_hw.h>
#include <transmission_interface/transmission_info.h>
#include <urdf/model.h>
#include <gazebo/common/common.hh>
#include <gazebo/gazebo.hh>
#include <gazebo/physics/physics.hh>

namespace gazebo_ros_control {

struct JointData {
  JointData(const std::string& name, const std::string& hardware_interface)
      : name_(name), hardware_interface_(hardware_interface) {}
  std::string name_, hardware_interface_;
};

/** Hardware of a simulated robot, which reads and drives its joints. */
class RobotHWSim : public hardware_interface::RobotHW {
 public:
  virtual ~RobotHWSim() {}
  /** Prepare for a model; false if it cannot be controlled. */
  virtual bool initSim(const std::string& robot_namespace, ros::NodeHandle model_nh,
                       gazebo::physics::ModelPtr parent_model, const urdf::Model* const urdf_model,
                       std::vector<transmission_interface::TransmissionInfo> transmissions) = 0;
  /** Before the controllers' updates, and after them. */
  virtual void readSim(ros::Time time, ros::Duration period) = 0;
  virtual void writeSim(ros::Time time, ros::Duration period) = 0;
  virtual void eStopActive(const bool) {}
};
typedef boost::shared_ptr<RobotHWSim> RobotHWSimPtr;

}  // namespace gazebo_ros_control
